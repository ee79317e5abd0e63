// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

namespace pharos {

/// Vector of at most N elements inside the object itself: the portable core uses no heap.
///
/// Policy when full: push_back refuses and returns false; the caller counts what it lost.
template <class T, std::size_t N>
class StaticVector {
 public:
  using value_type = T;
  static constexpr std::size_t kCapacity = N;

  constexpr bool push_back(const T& item) {
    if (size_ == N) return false;
    items_[size_++] = item;
    return true;
  }
  constexpr void pop_back() { --size_; }
  constexpr void clear() { size_ = 0; }
  /// Shrinks, or grows with elements that keep their last value; `size` is limited to the capacity.
  constexpr void resize(std::size_t size) { size_ = size < N ? size : N; }
  /// Removes element `index` in constant time; the last element moves to its index.
  constexpr void erase_unordered(std::size_t index) { items_[index] = items_[--size_]; }

  constexpr std::size_t size() const { return size_; }
  constexpr bool empty() const { return size_ == 0; }
  constexpr bool full() const { return size_ == N; }
  constexpr T& operator[](std::size_t index) { return items_[index]; }
  constexpr const T& operator[](std::size_t index) const { return items_[index]; }
  constexpr T& back() { return items_[size_ - 1]; }
  constexpr const T& back() const { return items_[size_ - 1]; }
  constexpr T* data() { return items_.data(); }
  constexpr const T* data() const { return items_.data(); }
  constexpr T* begin() { return items_.data(); }
  constexpr T* end() { return items_.data() + size_; }
  constexpr const T* begin() const { return items_.data(); }
  constexpr const T* end() const { return items_.data() + size_; }

 private:
  std::array<T, N> items_{};
  std::size_t size_ = 0;
};

}  // namespace pharos
