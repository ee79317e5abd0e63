// SPDX-License-Identifier: Apache-2.0
#include "pharos/wire/cobs.hpp"

namespace pharos::wire {
namespace {

constexpr std::uint8_t kFullBlock = 0xFF;  // 254 plain bytes and no zero after them

}  // namespace

CobsWriter::CobsWriter(std::span<std::uint8_t> out) : out_(out) { open_block(); }

void CobsWriter::open_block() {
  code_at_ = size_;
  code_ = 1;
  if (size_ == out_.size()) {
    overflow_ = true;
  } else {
    ++size_;
  }
}

void CobsWriter::put(std::uint8_t byte) {
  // A full block is closed only when something follows it: at the very end it stands without a successor.
  if (code_ == kFullBlock && !overflow_) {
    out_[code_at_] = code_;
    open_block();
  }
  if (overflow_) return;
  if (byte == 0) {
    out_[code_at_] = code_;
    open_block();
  } else if (size_ == out_.size()) {
    overflow_ = true;
  } else {
    out_[size_++] = byte;
    ++code_;
  }
}

void CobsWriter::put(std::span<const std::uint8_t> bytes) {
  for (const std::uint8_t byte : bytes) put(byte);
}

std::size_t CobsWriter::finish() {
  if (overflow_) return 0;
  out_[code_at_] = code_;
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
