// SPDX-License-Identifier: Apache-2.0
#include "pharos/wire/cobs.hpp"

#include <algorithm>

namespace pharos::wire {
namespace {

constexpr std::uint8_t kFullBlock = 0xFF;  // 254 plain bytes and no zero after them

}  // namespace

CobsWriter::CobsWriter(std::span<std::uint8_t> out) : out_(out), size_(1), overflow_(out.empty()) {}

// Every byte of a line passes here: state that changes with it stays in registers.
void CobsWriter::put(std::span<const std::uint8_t> bytes) {
  if (overflow_) return;
  std::uint8_t* const out = out_.data();
  std::size_t block = block_;
  std::size_t size = size_;
  std::size_t stop = end_of_block(block);
  for (const std::uint8_t byte : bytes) {
    // A full block is closed only when something follows it: at the very end it stands without a successor.
    while (size == stop) {
      if (size - block != kFullBlock || size == out_.size()) {
        overflow_ = true;
        return;
      }
      out[block] = kFullBlock;
      block = size++;
      stop = end_of_block(block);
    }
    if (byte != 0) {
      out[size++] = byte;
    } else {
      out[block] = static_cast<std::uint8_t>(size - block);
      block = size++;
      stop = end_of_block(block);
    }
  }
  block_ = block;
  size_ = size;
}

std::size_t CobsWriter::finish() {
  if (overflow_) return 0;
  out_[block_] = static_cast<std::uint8_t>(size_ - block_);
  return size_;
}

std::optional<std::size_t> cobs_decode_in_place(std::span<std::uint8_t> bytes) {
  std::size_t read = 0;
  std::size_t write = 0;
  while (read < bytes.size()) {
    const std::uint8_t code = bytes[read++];
    const std::size_t run = static_cast<std::size_t>(code) - 1;
    if (code == 0 || bytes.size() - read < run) return std::nullopt;
    for (std::size_t i = 0; i < run; ++i) {
      if (bytes[read] == 0) return std::nullopt;
      bytes[write++] = bytes[read++];
    }
    if (code != kFullBlock && read < bytes.size()) bytes[write++] = 0;
  }
  return write;
}

}  // namespace pharos::wire
