// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace pharos::wire {

/// Zero-free byte stuffing: Cheshire and Baker, "Consistent Overhead Byte Stuffing" (SIGCOMM 1997).
///
/// Writes stuffed bytes into `out` as they arrive; never past its end.
class CobsWriter {
 public:
  explicit CobsWriter(std::span<std::uint8_t> out);
  void put(std::span<const std::uint8_t> bytes);
  /// Closes the last block. Returns the stuffed bytes written, or 0 when they did not fit.
  std::size_t finish();

 private:
  /// Index at which a block that begins there is full, or the memory ends.
  std::size_t end_of_block(std::size_t block) const { return std::min(block + 255, out_.size()); }

  std::span<std::uint8_t> out_;
  std::size_t block_ = 0;  // where the open block begins: with its length
  std::size_t size_;
  bool overflow_;
};

/// Removes the stuffing in place. Plain bytes, at the front of `bytes`; empty when the stuffing is broken (a zero
/// within, or a block that runs past the end).
std::optional<std::size_t> cobs_decode_in_place(std::span<std::uint8_t> bytes);

}  // namespace pharos::wire
