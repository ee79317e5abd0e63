// SPDX-License-Identifier: Apache-2.0
#include "pharos/ellipse/smooth.hpp"

#include <algorithm>
#include <bit>

namespace pharos::ellipse {
namespace {

using Value = std::uint16_t;

// Half the sum, rounded up, without leaving 16 bits: compilers make it of vectors.
inline Value mean(Value a, Value b) { return static_cast<Value>((a | b) - ((a ^ b) >> 1)); }

// (1 4 6 4 1)/16 is the mean of two neighbours taken four times over.
inline Value binomial(Value p0, Value p1, Value p2, Value p3, Value p4) {
  const Value a = mean(p0, p1), b = mean(p1, p2), c = mean(p2, p3), d = mean(p3, p4);
  const Value ab = mean(a, b), bc = mean(b, c), cd = mean(c, d);
  return mean(mean(ab, bc), mean(bc, cd));
}

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
  const auto at = [&](std::int32_t u) {
    return static_cast<Value>(in[std::clamp<std::int32_t>(u, 0, width - 1)] << shift);
  };
  const auto inside = [&](std::int32_t u) { return static_cast<Value>(in[u] << shift); };
  const auto near_border = [&](std::int32_t u) {
    out[u] = binomial(at(u - 2), at(u - 1), at(u), at(u + 1), at(u + 2));
  };
  for (std::int32_t u = 0; u < std::min<std::int32_t>(2, width); ++u) near_border(u);
  for (std::int32_t u = 2; u < width - 2; ++u) {
    out[u] = binomial(inside(u - 2), inside(u - 1), inside(u), inside(u + 1), inside(u + 2));
  }
  for (std::int32_t u = std::max<std::int32_t>(2, width - 2); u < width; ++u) near_border(u);
}

}  // namespace

int smooth(ImageView<const Value> image, ImageView<Value> scratch, ImageView<Value> smoothed) {
  const int shift = free_bits(image);
  for (std::int32_t v = 0; v < image.height_px; ++v) smooth_row(image.row(v), scratch.row(v), image.width_px, shift);
  for (std::int32_t v = 0; v < image.height_px; ++v) {
    const auto row = [&](std::int32_t w) { return scratch.row(std::clamp<std::int32_t>(w, 0, image.height_px - 1)); };
    const Value *r0 = row(v - 2), *r1 = row(v - 1), *r2 = row(v), *r3 = row(v + 1), *r4 = row(v + 2);
    Value* out = smoothed.row(v);
    for (std::int32_t u = 0; u < image.width_px; ++u) out[u] = binomial(r0[u], r1[u], r2[u], r3[u], r4[u]);
  }
  return shift;
}

}  // namespace pharos::ellipse
