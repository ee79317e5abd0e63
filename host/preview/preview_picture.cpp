// SPDX-License-Identifier: Apache-2.0
#include "host/preview/preview_picture.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace pharos::host {
namespace {

// Of JPEG; below the last one blocks show.
constexpr std::array kQualities = {75, 55, 35};
constexpr int kWhite16 = 257;  // 8 bits to 16

// Means of squares of `factor` pixels a side; what is left over at the right and lower edge is dropped.
std::vector<std::uint16_t> reduced(const AnnotatedImage& image, int factor, std::int32_t width, std::int32_t height) {
  std::vector<std::uint16_t> out;
  out.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  std::vector<std::uint32_t> sums(static_cast<std::size_t>(width));
  const auto squared = static_cast<std::uint32_t>(factor * factor);
  for (std::int32_t v = 0; v < height; ++v) {
    std::fill(sums.begin(), sums.end(), 0U);
    for (int row = 0; row < factor; ++row) {
      const std::uint16_t* from =
          &image.pixels[static_cast<std::size_t>(v * factor + row) * static_cast<std::size_t>(image.width_px)];
      for (std::uint32_t& sum : sums) {
        for (int k = 0; k < factor; ++k) sum += *from++;
      }
    }
    for (const std::uint32_t sum : sums) out.push_back(static_cast<std::uint16_t>(sum / squared));
  }
  return out;
}

}  // namespace

AnnotatedImage annotated_image(ImageView<const std::uint16_t> image, Drawing drawing, std::string view) {
  AnnotatedImage out{std::move(view), image.width_px, image.height_px, {}, std::move(drawing)};
  out.pixels.reserve(image.pixels());
  for (std::int32_t v = 0; v < image.height_px; ++v) {
    out.pixels.insert(out.pixels.end(), image.row(v), image.row(v) + image.width_px);
  }
  return out;
}

AnnotatedImage annotated_image(ImageView<const std::uint8_t> image, Drawing drawing, std::string view) {
  AnnotatedImage out{std::move(view), image.width_px, image.height_px, {}, std::move(drawing)};
  out.pixels.reserve(image.pixels());
  for (std::int32_t v = 0; v < image.height_px; ++v) {
    std::transform(image.row(v), image.row(v) + image.width_px, std::back_inserter(out.pixels),
                   [](std::uint8_t value) { return static_cast<std::uint16_t>(kWhite16 * value); });
  }
  return out;
}

std::vector<std::uint8_t> preview_jpeg(const AnnotatedImage& image) {
  if (image.pixels.empty()) return {};
  int factor = (image.width_px + kMaxPreviewWidth_px - 1) / kMaxPreviewWidth_px;
  for (;; factor *= 2) {
    const std::int32_t width = image.width_px / factor, height = image.height_px / factor;
    if (width == 0 || height == 0) return {};
    const std::vector<std::uint16_t> pixels = reduced(image, factor, width, height);
    Canvas canvas({pixels.data(), width, height}, 1);
    image.drawing.draw(canvas, {factor});
    for (const int quality : kQualities) {
      std::vector<std::uint8_t> jpeg = canvas.jpeg(quality);
      if (!jpeg.empty() && jpeg.size() <= kMaxPreviewBytes) return jpeg;
    }
  }
}

}  // namespace pharos::host
