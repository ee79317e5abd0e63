// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "host/preview/drawing.hpp"
#include "pharos/base/image_view.hpp"

namespace pharos::host {

/// A camera's image with what was found in it: complete in itself, for another thread.
struct AnnotatedImage {
  std::string view;  // of a rig "left" or "right"; otherwise empty
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
  std::vector<std::uint16_t> pixels;
  Drawing drawing;
};

AnnotatedImage annotated_image(ImageView<const std::uint16_t> image, Drawing drawing, std::string view = "");
/// Of 8 bits a pixel.
AnnotatedImage annotated_image(ImageView<const std::uint8_t> image, Drawing drawing, std::string view = "");

/// Most bytes of a preview: with its header it is one packet of LCM.
inline constexpr std::size_t kMaxPreviewBytes = 32 * 1024;
/// Widest preview.
inline constexpr std::int32_t kMaxPreviewWidth_px = 640;

/// A JPEG of at most kMaxPreviewBytes: the image reduced by a whole factor to kMaxPreviewWidth_px at most, in the grey
/// of a Canvas, with its drawing. If it is larger, its quality is lowered, then its size. Empty for an empty image.
std::vector<std::uint8_t> preview_jpeg(const AnnotatedImage& image);

}  // namespace pharos::host
