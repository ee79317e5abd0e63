// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

namespace pharos {

/// First-in first-out queue of at most N elements inside the object.
///
/// Policy when full: push refuses and returns false; the caller counts the loss. One thread only.
template <class T, std::size_t N>
class RingBuffer {
 public:
  static constexpr std::size_t kCapacity = N;

  constexpr bool push(const T& item) {
    if (size_ == N) return false;
    items_[wrap(head_ + size_)] = item;
    ++size_;
    return true;
  }
  /// Removes the oldest element; the ring must not be empty.
  constexpr T pop() {
    const T item = items_[head_];
    drop();
    return item;
  }
  /// Removes the oldest element without returning it.
  constexpr void drop() {
    head_ = wrap(head_ + 1);
    --size_;
  }
  /// Element `index` counted from the oldest.
  constexpr const T& operator[](std::size_t index) const { return items_[wrap(head_ + index)]; }
  constexpr const T& front() const { return items_[head_]; }
  constexpr std::size_t size() const { return size_; }
  constexpr bool empty() const { return size_ == 0; }
  constexpr bool full() const { return size_ == N; }
  constexpr void clear() { head_ = size_ = 0; }

 private:
  static constexpr std::size_t wrap(std::size_t index) { return index < N ? index : index - N; }

  std::array<T, N> items_{};
  std::size_t head_ = 0;
  std::size_t size_ = 0;
};

}  // namespace pharos
