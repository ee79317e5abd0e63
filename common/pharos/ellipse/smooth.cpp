// SPDX-License-Identifier: Apache-2.0
#include "pharos/ellipse/smooth.hpp"

#include <algorithm>
#include <array>
#include <bit>

namespace pharos::ellipse {
namespace {

using Value = std::uint16_t;

// Half the sum, rounded up, without leaving 16 bits: compilers make it of vectors.
inline Value mean(Value a, Value b) { return static_cast<Value>((a | b) - ((a ^ b) >> 1)); }

// (1 4 6 4 1)/16 is the mean of two neighbours taken four times over. So wide a strip at a time, what is between stays
// in the nearest cache.
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

// A strip from top to bottom; each row of the image is read once.
void smooth_strip(ImageView<const Value> in, ImageView<Value> out, std::int32_t begin, std::int32_t count) {
  Strip row{}, once{}, twice{}, thrice{};  // the last row, and what was made with it
  const auto read = [&](std::int32_t v) { return in.row(std::clamp<std::int32_t>(v, 0, in.height_px - 1)) + begin; };
  std::copy_n(read(-kReach_px), count, row.begin());
  for (std::int32_t v = 1 - kReach_px; v < in.height_px + kReach_px; ++v) {
    const Value* next = read(v);
    // What the first three rows make is not whole yet, and goes where the fourth one overwrites it.
    Value* result = out.row(std::max<std::int32_t>(0, v - kReach_px)) + begin;
    for (std::int32_t k = 0; k < count; ++k) {
      const auto i = static_cast<std::size_t>(k);
      const Value first = mean(row[i], next[k]), second = mean(once[i], first), third = mean(twice[i], second);
      result[k] = mean(thrice[i], third);
      row[i] = next[k];
      once[i] = first;
      twice[i] = second;
      thrice[i] = third;
    }
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
