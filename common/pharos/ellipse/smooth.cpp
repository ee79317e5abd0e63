// SPDX-License-Identifier: Apache-2.0
#include "pharos/ellipse/smooth.hpp"

#include <algorithm>
#include <array>
#include <bit>

namespace pharos::ellipse {
namespace {

using Value = std::uint16_t;

// Half the sum, rounded up. Compilers use the vector instruction for it where a loop does nothing else.
inline Value mean(Value a, Value b) { return static_cast<Value>((a + b + 1) >> 1); }

void take_means(const Value* a, const Value* b, std::int32_t count, Value* out) {
  for (std::int32_t k = 0; k < count; ++k) out[k] = mean(a[k], b[k]);
}

// (1 4 6 4 1)/16 is the mean of two neighbours taken four times in succession. The strip is narrow enough for
// intermediate results to stay in the nearest cache.
constexpr std::int32_t kStrip_px = 256;
constexpr std::int32_t kReach_px = 2;
using Strip = std::array<Value, kStrip_px>;

int free_bits(ImageView<const Value> image) {
  unsigned used = 0;
  for (std::int32_t v = 0; v < image.height_px; ++v) {
    const Value* row = image.row(v);
    Value row_used = 0;
    for (std::int32_t u = 0; u < image.width_px; ++u) row_used = static_cast<Value>(row_used | row[u]);
    used |= row_used;
  }
  return 16 - static_cast<int>(std::bit_width(used));
}

void smooth_row(const Value* in, Value* out, std::int32_t width, int shift) {
  std::array<Value, kStrip_px + 2 * kReach_px> strip{};
  for (std::int32_t begin = 0; begin < width; begin += kStrip_px) {
    const std::int32_t count = std::min(kStrip_px, width - begin);
    Value* values = strip.data();
    const Value* from = in + begin;
    for (std::int32_t k = 0; k < count; ++k) values[kReach_px + k] = static_cast<Value>(from[k] << shift);
    for (std::int32_t k = 0; k < kReach_px; ++k) {
      values[k] = static_cast<Value>(in[std::max<std::int32_t>(0, begin + k - kReach_px)] << shift);
      values[kReach_px + count + k] =
          static_cast<Value>(in[std::min<std::int32_t>(width - 1, begin + count + k)] << shift);
    }
    for (std::int32_t left = 2 * kReach_px - 1; left >= 0; --left) {
      for (std::int32_t k = 0; k < count + left; ++k) values[k] = mean(values[k], values[k + 1]);
    }
    std::copy_n(values, count, out + begin);
  }
}

// A strip from top to bottom: the means of two rows, of three and of four are made from those of the row before.
void smooth_strip(ImageView<const Value> in, ImageView<Value> out, std::int32_t begin, std::int32_t count) {
  constexpr std::size_t kMeans = 3;
  std::array<std::array<Strip, kMeans>, 2> means{};
  std::size_t last = 0;
  const auto read = [&](std::int32_t v) { return in.row(std::clamp<std::int32_t>(v, 0, in.height_px - 1)) + begin; };
  for (std::int32_t v = 1 - kReach_px; v < in.height_px + kReach_px; ++v, last = 1 - last) {
    const auto& before = means[last];
    auto& made = means[1 - last];
    take_means(read(v - 1), read(v), count, made[0].data());
    for (std::size_t k = 1; k < kMeans; ++k)
      take_means(before[k - 1].data(), made[k - 1].data(), count, made[k].data());
    // The results of the first three rows are incomplete, and are overwritten by the fourth.
    Value* result = out.row(std::max<std::int32_t>(0, v - kReach_px)) + begin;
    take_means(before[kMeans - 1].data(), made[kMeans - 1].data(), count, result);
  }
}

}  // namespace

int smooth(ImageView<const Value> image, ImageView<Value> scratch, ImageView<Value> smoothed) {
  const int shift = free_bits(image);
  for (std::int32_t v = 0; v < image.height_px; ++v) smooth_row(image.row(v), scratch.row(v), image.width_px, shift);
  for (std::int32_t begin = 0; begin < image.width_px; begin += kStrip_px) {
    smooth_strip(scratch, smoothed, begin, std::min(kStrip_px, image.width_px - begin));
  }
  return shift;
}

}  // namespace pharos::ellipse
