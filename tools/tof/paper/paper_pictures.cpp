// SPDX-License-Identifier: Apache-2.0
#include "tools/tof/paper/paper_pictures.hpp"

#include <array>
#include <utility>

#include "host/images/canvas.hpp"
#include "host/images/grey_image.hpp"

namespace pharos::tools::paper000 {
namespace {

namespace colours = host::colours;

std::vector<std::uint16_t> wide(const std::vector<std::uint8_t>& values) {
  std::vector<std::uint16_t> pixels;
  for (const std::uint8_t value : values) pixels.push_back(static_cast<std::uint16_t>(value * 257));
  return pixels;
}

void draw(host::Canvas& canvas, const Arc& arc, host::Colour colour) {
  std::vector<host::Place> places;
  for (const Vector2& p : arc) places.push_back({p.x(), p.y()});
  canvas.polyline(places, colour, 1.0);
}

void draw(host::Canvas& canvas, const PaperEllipse& e, host::Colour colour) {
  canvas.ellipse({e.cx_px, e.cy_px}, e.a_px, e.b_px, e.theta_rad, colour);
}

void draw(host::Canvas& canvas, const Region& region, host::Colour colour) {
  for (const auto& [u, v] : region.pixels) canvas.tint(u, v, colour, 0.7);
}

class Album {
 public:
  Album(std::string prefix, const ChainStages& stages)
      : prefix_(std::move(prefix)), stages_(stages), grey_(wide(stages.grey)) {}

  void plain(const char* figure, const char* caption, const char* file, const std::vector<std::uint8_t>& values) {
    host::write_grey_png(prefix_ + file, view(wide(values)), 8);
    pictures_.push_back({figure, caption, prefix_ + file});
  }
  template <class Drawings>
  void drawn(const char* figure, const char* caption, const char* file, const Drawings& drawings, host::Colour colour) {
    host::Canvas canvas(view(grey_), 1);
    for (const auto& one : drawings) draw(canvas, one, colour);
    canvas.write_png(prefix_ + file);
    pictures_.push_back({figure, caption, prefix_ + file});
  }
  std::vector<StagePicture> pictures() && { return std::move(pictures_); }

 private:
  ImageView<const std::uint16_t> view(const std::vector<std::uint16_t>& pixels) const {
    return {pixels.data(), stages_.width_px, stages_.height_px};
  }

  std::string prefix_;
  const ChainStages& stages_;
  std::vector<std::uint16_t> grey_;
  std::vector<StagePicture> pictures_;
};

void add_regions(const ChainStages& stages, Album& album) {
  constexpr std::array<std::array<const char*, 2>, 4> kRules = {{{"after morphology", "6c_morphology.png"},
                                                                 {"after the rule of area", "6d_area.png"},
                                                                 {"after the rule of aspect ratio", "6e_aspect.png"},
                                                                 {"after the rule of filling", "6f_filling.png"}}};
  album.plain("figure 6", "above the local threshold (5)", "6b_above.png", stages.above);
  for (std::size_t k = 0; k < kRules.size(); ++k) {
    album.drawn("figure 6", kRules[k][0], kRules[k][1], stages.regions[k], colours::kGreen);
  }
}

}  // namespace

std::vector<StagePicture> write_stage_pictures(const std::string& prefix, const ChainStages& stages) {
  Album album(prefix, stages);
  album.plain("figure 5", "depth in 256 grey values, near is bright", "5a_grey.png", stages.grey);
  album.drawn("figure 5", "edges", "5b_edges.png", stages.edges, colours::kOrange);
  album.drawn("figure 5", "arcs", "5c_arcs.png", stages.arcs, colours::kYellow);
  album.drawn("figure 5", "fitted ellipses", "5d_fitted.png", stages.fitted, colours::kSky);
  album.drawn("figure 5", "after clustering and verification", "5e_accepted.png", stages.accepted, colours::kPink);
  std::vector<PaperEllipse> ring;
  if (stages.ring) ring.assign(stages.ring->begin(), stages.ring->end());
  album.drawn("figure 5", "the ring's two ellipses", "5f_ring.png", ring, colours::kGreen);
  if (!stages.above.empty()) add_regions(stages, album);
  return std::move(album).pictures();
}

void write_amplitude_picture(const std::string& prefix, ImageView<const std::uint16_t> intensity) {
  host::Canvas(intensity, 1).write_png(prefix + "5_amplitude.png");
}

}  // namespace pharos::tools::paper000
