// SPDX-License-Identifier: Apache-2.0
#include "tools/pointing/paper/paper_pictures.hpp"

#include "host/images/canvas.hpp"
#include "host/images/grey_image.hpp"

namespace pharos::tools::paper003 {
namespace {

void draw(host::Canvas& canvas, const LineSegment& segment, host::Colour colour, double width) {
  canvas.line({segment.begin.x(), segment.begin.y()}, {segment.end.x(), segment.end.y()}, colour, width);
}

}  // namespace

void write_stage_pictures(const std::string& prefix, const Stages& stages, std::int32_t width_px,
                          std::int32_t height_px) {
  std::vector<std::uint16_t> pixels;
  for (const std::uint8_t value : stages.binary) pixels.push_back(static_cast<std::uint16_t>(value * 257));
  const ImageView<const std::uint16_t> view(pixels.data(), width_px, height_px);
  host::write_grey_png(prefix + "binary.png", view, 8);
  host::Canvas canvas(view, 1);
  for (const LineSegment& segment : stages.segments) draw(canvas, segment, host::colours::kOrange, 1.5);
  if (stages.found) {
    for (const LineSegment& edge : stages.long_edges) draw(canvas, edge, host::colours::kGreen, 3.0);
    for (const LineSegment& edge : stages.short_edges) draw(canvas, edge, host::colours::kGreen, 3.0);
  }
  canvas.write_png(prefix + "segments.png");
}

}  // namespace pharos::tools::paper003
