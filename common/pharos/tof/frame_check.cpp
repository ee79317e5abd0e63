// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/frame_check.hpp"

#include <algorithm>
#include <cstring>

#include "pharos/tof/constants.hpp"

namespace pharos::tof {
namespace {

// A ring needs only a few thousand pixels with depth, but so few in a whole frame are noise.
constexpr std::int32_t kMinDepthFraction = 200;  // one pixel in this many
// Empty rows, or rows that are equal by chance, are fewer.
constexpr std::int32_t kMinStaleRows = 8;

struct RowContent {
  std::uint64_t hash = 0;
  std::int32_t with_depth = 0;
  std::int32_t saturated = 0;
};

// Multiplied and mixed (FNV-1a) four values at a time, the product's upper half into its lower one, as multiplying does
// not reach down. In two chains: a multiplication takes longer than all else here.
class RowHash {
 public:
  void add(const std::uint16_t* values, std::int32_t count) {
    constexpr std::int32_t kTogether = sizeof(std::uint64_t) / sizeof(std::uint16_t);
    std::uint64_t even = hash_, odd = ~hash_;
    std::int32_t u = 0;
    for (; u + 2 * kTogether <= count; u += 2 * kTogether) {
      even = mixed(even, word_at(values + u, kTogether));
      odd = mixed(odd, word_at(values + u + kTogether, kTogether));
    }
    for (; u < count; u += kTogether) even = mixed(even, word_at(values + u, std::min(kTogether, count - u)));
    hash_ = mixed(even, odd);
  }
  std::uint64_t value() const { return hash_; }

 private:
  static std::uint64_t word_at(const std::uint16_t* values, std::int32_t count) {
    std::uint64_t word = 0;
    std::memcpy(&word, values, static_cast<std::size_t>(count) * sizeof(std::uint16_t));
    return word;
  }
  static std::uint64_t mixed(std::uint64_t hash, std::uint64_t word) {
    constexpr std::uint64_t kPrime = 0x100000001b3U;
    const std::uint64_t product = (hash ^ word) * kPrime;
    return product ^ (product >> 32U);
  }

  std::uint64_t hash_ = 0xcbf29ce484222325U;
};

// The hash is 0 where no pixel has depth.
RowContent read_row(const TofFrame& frame, std::int32_t v) {
  RowContent content;
  const std::uint16_t* depth = frame.depth.row(v);
  const std::uint16_t* intensity = frame.intensity.row(v);
  for (std::int32_t u = 0; u < frame.depth.width_px; ++u) content.with_depth += has_depth(depth[u]) ? 1 : 0;
  for (std::int32_t u = 0; u < frame.depth.width_px; ++u) content.saturated += intensity[u] == kFullScale ? 1 : 0;
  if (content.with_depth == 0) return content;
  RowHash hash;
  hash.add(depth, frame.depth.width_px);
  hash.add(intensity, frame.depth.width_px);
  content.hash = hash.value() | 1U;
  return content;
}

bool depth_scale_is_usable(const DepthCamera& camera) {
  return camera.depth_scale_m > 0.0 && camera.depth_scale_m < 1.0 && camera.depth_origin_z_m > -10.0 &&
         camera.depth_origin_z_m < 10.0;
}

}  // namespace

std::optional<TofFailure> FrameCheck::check(const TofFrame& frame, const DepthCamera& camera) {
  if (frame.intensity.empty() || frame.depth.empty() || !frame.intensity.same_size(frame.depth) ||
      frame.depth.width_px > kMaxWidth_px || frame.depth.height_px > kMaxHeight_px) {
    return TofFailure::kFrameSize;
  }
  if (camera.intrinsics.width_px != frame.depth.width_px || camera.intrinsics.height_px != frame.depth.height_px) {
    return TofFailure::kCameraSize;
  }
  if (!is_usable(camera.intrinsics) || !depth_scale_is_usable(camera)) return TofFailure::kCameraUnusable;
  const bool comparable = height_px_ == frame.depth.height_px;
  height_px_ = frame.depth.height_px;
  std::int32_t with_depth = 0;
  std::int32_t saturated = 0;
  std::int32_t rows = 0;
  std::int32_t repeated = 0;
  for (std::int32_t v = 0; v < frame.depth.height_px; ++v) {
    const RowContent content = read_row(frame, v);
    std::uint64_t& before = rows_[static_cast<std::size_t>(v)];
    with_depth += content.with_depth;
    saturated += content.saturated;
    rows += content.hash != 0 ? 1 : 0;
    repeated += content.hash != 0 && content.hash == before ? 1 : 0;
    before = content.hash;
  }
  const auto pixels = static_cast<std::int32_t>(frame.depth.pixels());
  if (2 * saturated > pixels) return TofFailure::kSaturated;
  if (with_depth < pixels / kMinDepthFraction) return TofFailure::kNoDepth;
  // A frame that repeats as a whole is old, but valid.
  if (comparable && repeated >= kMinStaleRows && repeated < rows) return TofFailure::kStaleRows;
  return std::nullopt;
}

}  // namespace pharos::tof
