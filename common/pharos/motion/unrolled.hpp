// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <type_traits>
#include <utility>

namespace pharos::motion {

/// f(0) to f(n - 1), each with its number as a constant.
template <int n, class Function>
inline void for_each_number(const Function& f) {
  [&f]<int... k>(std::integer_sequence<int, k...>) { (f(std::integral_constant<int, k>{}), ...); }
  (std::make_integer_sequence<int, n>{});
}

/// The last even number up to this one: where packets of two begin.
constexpr int even(int number) { return number - number % 2; }

}  // namespace pharos::motion
