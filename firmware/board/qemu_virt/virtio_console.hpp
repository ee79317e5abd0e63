// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace pharos::board {

/// Input of a virtio console over virtio-mmio (legacy interface, which QEMU's `virt` offers by default): bytes from a
/// file, pipe or socket on the host that wait there, none lost, while this side has no buffer free.
/// `-device virtio-serial-device -device virtconsole,chardev=…`; Virtual I/O Device specification 1.1, 4.2.4 and 5.3.
class VirtioConsole {
 public:
  /// Buffers and ring lie in device memory (.device), which represents the capture block's FIFO and not the program's
  /// memory.
  bool start();
  /// Received bytes: as many as are contiguous, at most `most`; empty when there are none. Valid until the next call.
  std::span<const volatile std::uint8_t> read(std::size_t maximum);

 private:
  void offer(std::uint16_t buffer);

  std::uintptr_t base_ = 0;
  std::uint16_t taken_ = 0;   // buffers taken back, wrapping
  std::size_t at_ = 0;        // in the buffer being read
  std::size_t size_ = 0;      // of it; 0: none
  std::uint16_t buffer_ = 0;  // its number
};

}  // namespace pharos::board
