// SPDX-License-Identifier: Apache-2.0
#include "pharos/wire/frame_decoder.hpp"

#include <span>

#include "pharos/wire/bytes.hpp"
#include "pharos/wire/cobs.hpp"
#include "pharos/wire/crc32.hpp"

namespace pharos::wire {
namespace {

/// A larger jump is a sender that restarted, not a loss: at 250 frames/s this many are 16 s of silence.
constexpr std::uint16_t kLargestCredibleGap = 4096;
/// A number this little behind the last one is a frame that arrived twice or too late, not a restart.
constexpr std::uint16_t kReplayWindow = 64;

}  // namespace

std::optional<Frame> FrameDecoder::push(std::uint8_t byte) {
  ++counters_.bytes;
  if (byte == kFrameDelimiter) return finish_frame();
  if (size_ < buffer_.size()) buffer_[size_] = byte;
  ++size_;
  return std::nullopt;
}

void FrameDecoder::restart() {
  counters_.garbage_bytes += size_;
  size_ = 0;
  mid_frame_ = true;
  reopened_ = true;
}

void FrameDecoder::drop(std::uint64_t& cause, std::size_t bytes_on_line) {
  counters_.garbage_bytes += bytes_on_line;
  // Bytes before the first border are not a failed frame but the end of one that began before reception.
  if (!mid_frame_) ++cause;
}

std::optional<Frame> FrameDecoder::finish_frame() {
  const std::size_t bytes_on_line = size_;
  size_ = 0;
  std::optional<Frame> frame;
  if (bytes_on_line > buffer_.size()) {
    drop(counters_.too_long, bytes_on_line);
  } else if (bytes_on_line > 0) {
    const auto plain = cobs_decode_in_place(std::span(buffer_).first(bytes_on_line));
    if (plain) {
      frame = check_frame(*plain, bytes_on_line);
    } else {
      drop(counters_.bad_stuffing, bytes_on_line);
    }
  }
  mid_frame_ = false;
  return frame;
}

std::optional<Frame> FrameDecoder::check_frame(std::size_t size, std::size_t bytes_on_line) {
  if (size < kHeaderBytes + kCrcBytes) {
    drop(counters_.too_short, bytes_on_line);
    return std::nullopt;
  }
  const std::span<const std::uint8_t> bytes = std::span(buffer_).first(size);
  const auto crc = ByteReader(bytes.last(kCrcBytes)).get<std::uint32_t>();
  if (crc != crc32(bytes.first(size - kCrcBytes))) {
    drop(counters_.bad_crc, bytes_on_line);
    return std::nullopt;
  }
  ByteReader header(bytes);
  const auto version = header.get<std::uint8_t>();
  if (version != kProtocolVersion) {
    ++counters_.wrong_version;
    unsupported_version_ = version;
    return std::nullopt;
  }
  Frame frame;
  frame.type = static_cast<MessageType>(header.get<std::uint8_t>());
  frame.sequence = header.get<std::uint16_t>();
  frame.payload = bytes.subspan(kHeaderBytes, size - kHeaderBytes - kCrcBytes);
  if (!check_sequence(frame, crc)) return std::nullopt;
  if (!is_known(frame.type)) {
    ++counters_.unknown_type;
    return std::nullopt;
  }
  ++counters_.frames;
  return frame;
}

bool FrameDecoder::check_sequence(const Frame& frame, std::uint32_t crc) {
  const bool first = !any_frame_;
  const auto gap = static_cast<std::uint16_t>(frame.sequence - last_sequence_ - 1);
  const auto behind = static_cast<std::uint16_t>(last_sequence_ - frame.sequence);
  const bool same_again = frame.sequence == last_sequence_ && crc == last_crc_;
  const bool hello = frame.type == MessageType::kHello && frame.sequence == 0 && !same_again;
  // After a gap in the line a restart is as likely as a repeated frame.
  if (!first && !hello && !reopened_ && behind < kReplayWindow) {
    ++counters_.repeated;
    return false;
  }
  any_frame_ = true;
  reopened_ = false;
  last_sequence_ = frame.sequence;
  last_crc_ = crc;
  if (first || gap == 0) return true;
  if (hello || gap > kLargestCredibleGap) {
    ++counters_.restarts;
  } else {
    counters_.frames_lost += gap;
  }
  return true;
}

}  // namespace pharos::wire
