// SPDX-License-Identifier: Apache-2.0
#include "host/frame_record/frame_reader.hpp"

#include <bit>
#include <cstring>
#include <utility>
#include <variant>

#include "host/support/input_error.hpp"
#include "pharos/wire/bytes.hpp"

namespace pharos::host {
namespace {

using namespace frame_format;

static_assert(std::endian::native == std::endian::little, "pixels are little-endian, and copied");

/// Frames in a row whose pixels are damaged before their whole is skipped unsearched: a file full of notices does not
/// take a check of a frame's size for each.
constexpr int kMaxSearched = 8;
constexpr std::uint64_t kMaxSequence = std::uint64_t{1} << 60;

std::size_t notice_bytes(std::span<const std::uint8_t> mark) {
  return wire::ByteReader(mark.subspan(1)).get<std::uint16_t>();
}

}  // namespace

FrameReader::FrameReader(ByteSource source) : in_(std::move(source)) {
  const std::size_t whole = in_.have(kHeadBytes) ? head_bytes(in_.ahead(kHeadBytes)) : 0;
  if (whole == 0) {
    throw InputError(in_.name() +
                     ": is no recording of a camera that this release reads; those are made by pharosd's "
                     "[recording] with cameras = true");
  }
  const auto header = in_.have(whole) ? decode_head(in_.ahead(whole)) : std::nullopt;
  if (!header) {
    throw InputError(in_.name() + ": the head of this recording is damaged; nothing can be said of what follows");
  }
  header_ = *header;
  last_monotonic_ns_ = header_.monotonic_ns;
  in_.use(whole);
}

// The frame's notice, where one begins here.
std::optional<FrameNotice> FrameReader::notice_here() {
  if (!in_.have(kMarkBytes) || in_.ahead(1)[0] != kFrameMark) return std::nullopt;
  const std::size_t size = notice_bytes(in_.ahead(kMarkBytes));
  if (size > kMaxCameraMessage_bytes || !in_.have(kMarkBytes + size)) return std::nullopt;
  const auto message = decode_camera_message(in_.ahead(kMarkBytes + size).subspan(kMarkBytes));
  if (!message || !std::holds_alternative<FrameNotice>(*message)) return std::nullopt;
  const auto& notice = std::get<FrameNotice>(*message);
  const bool fits = notice.about.width_px == header_.width_px && notice.about.height_px == header_.height_px &&
                    notice.has_depth == header_.has_depth && notice.sequence < kMaxSequence;
  return fits ? std::optional(notice) : std::nullopt;
}

bool FrameReader::pixels_good(std::size_t head, std::size_t whole) {
  if (!in_.have(whole)) return false;
  const auto bytes = in_.ahead(whole);
  const auto crc = wire::ByteReader(bytes.last(kCrcBytes)).get<std::uint32_t>();
  return crc == crc_of(bytes.subspan(head, whole - head - kCrcBytes));
}

bool FrameReader::credible(const DepthFrame& frame) const {
  const std::int64_t since_ns = frame.complete_monotonic_ns - last_monotonic_ns_;
  return since_ns >= 0 && since_ns <= kLongestSilence_ns;
}

void FrameReader::take_pixels(std::span<const std::uint8_t> pixels, const FrameNotice& notice,
                              DepthFrame& frame) const {
  auto depth = std::move(frame.depth), intensity = std::move(frame.intensity);  // their memory is used again
  frame = notice.about;
  const std::size_t plane = pixels.size() / (header_.has_depth ? 2 : 1);
  depth.resize(header_.has_depth ? plane / sizeof(std::uint16_t) : 0);
  intensity.resize(plane / sizeof(std::uint16_t));
  if (header_.has_depth) std::memcpy(depth.data(), pixels.data(), plane);
  std::memcpy(intensity.data(), pixels.last(plane).data(), plane);
  frame.depth = std::move(depth);
  frame.intensity = std::move(intensity);
}

bool FrameReader::next(DepthFrame& frame) {
  std::uint64_t skipped = 0;
  int damaged = 0;
  while (in_.have(1)) {
    const std::optional<FrameNotice> notice = notice_here();
    const std::size_t head = notice ? kMarkBytes + notice_bytes(in_.ahead(kMarkBytes)) : 0;
    const std::size_t whole = head + header_.pixel_bytes() + kCrcBytes;
    if (!notice || !pixels_good(head, whole)) {
      const std::size_t step = notice && ++damaged > kMaxSearched && in_.have(whole) ? whole : 1;
      in_.use(step);
      skipped += step;
      continue;
    }
    counters_.dropped_bytes += std::exchange(skipped, 0);
    const auto bytes = in_.ahead(whole);
    in_.use(whole);
    if (!credible(notice->about)) {
      ++counters_.frames_bad_time;
      continue;
    }
    if (notice->sequence > last_sequence_ + 1 && last_sequence_ > 0) {
      counters_.frames_missing += static_cast<std::int64_t>(notice->sequence - last_sequence_ - 1);
    }
    last_sequence_ = notice->sequence;
    last_monotonic_ns_ = notice->about.complete_monotonic_ns;
    ++counters_.frames;
    take_pixels(bytes.subspan(head, header_.pixel_bytes()), *notice, frame);
    return true;
  }
  counters_.dropped_bytes += skipped;
  cut_off_ = cut_off_ || skipped > 0 || in_.cut_off();
  return false;
}

}  // namespace pharos::host
