// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

namespace pharos {

/// A value or the documented reason why there is none.
///
/// Replaces std::expected, which GCC 12's library has but clang 14 (clang-tidy, libFuzzer) does not accept. Both
/// members are plain values: no heap, no exceptions, trivially copyable when T and E are. T must be default
/// constructible. Reading value() of a failed result is a programming error; it returns the default T.
template <class T, class E>
class [[nodiscard]] Result {
 public:
  constexpr Result(T value) : value_(std::move(value)), ok_(true) {}  // NOLINT(google-explicit-constructor)
  constexpr Result(E error) : error_(error) {}                        // NOLINT(google-explicit-constructor)

  constexpr bool ok() const { return ok_; }
  constexpr explicit operator bool() const { return ok_; }
  constexpr const T& value() const { return value_; }
  constexpr T& value() { return value_; }
  constexpr const T& operator*() const { return value_; }
  constexpr T& operator*() { return value_; }
  constexpr const T* operator->() const { return &value_; }
  constexpr T* operator->() { return &value_; }
  constexpr E error() const { return error_; }

 private:
  T value_{};
  E error_{};
  bool ok_ = false;
};

}  // namespace pharos
