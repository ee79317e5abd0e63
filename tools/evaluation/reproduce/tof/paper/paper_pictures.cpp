// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/tof/paper/paper_pictures.hpp"

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
  Album(const ChainStages& stages, const std::filesystem::path& folder, report::PartResult& result)
      : stages_(stages), grey_(wide(stages.grey)), folder_(folder), result_(result) {}

  ImageView<const std::uint16_t> view(const std::vector<std::uint16_t>& pixels) const {
    return {pixels.data(), stages_.width_px, stages_.height_px};
  }
  void plain(const std::string& label, const std::string& caption, const std::string& file,
             const std::vector<std::uint8_t>& values) {
    host::write_grey_png((folder_ / file).string(), view(wide(values)), 8);
    result_.pictures.push_back({label, caption, file});
  }
  template <class Drawings>
  void drawn(const std::string& label, const std::string& caption, const std::string& file, const Drawings& drawings,
             host::Colour colour) {
    host::Canvas canvas(view(grey_), 1);
    for (const auto& one : drawings) draw(canvas, one, colour);
    canvas.write_png((folder_ / file).string());
    result_.pictures.push_back({label, caption, file});
  }

 private:
  const ChainStages& stages_;
  std::vector<std::uint16_t> grey_;
  std::filesystem::path folder_;
  report::PartResult& result_;
};

}  // namespace

void add_stage_pictures(const ChainStages& stages, const std::filesystem::path& folder, report::PartResult& result) {
  Album album(stages, folder, result);
  album.plain("figure 5", "depth in 256 grey values, near is bright", "depth.png", stages.grey);
  album.drawn("figure 5", "edges", "edges.png", stages.edges, colours::kOrange);
  album.drawn("figure 5", "arcs", "arcs.png", stages.arcs, colours::kYellow);
  album.drawn("figure 5", "fitted ellipses", "fitted.png", stages.fitted, colours::kSky);
  album.drawn("figure 5", "after clustering and verification", "accepted.png", stages.accepted, colours::kPink);
  std::vector<PaperEllipse> ring;
  if (stages.ring) ring.assign(stages.ring->begin(), stages.ring->end());
  album.drawn("figure 5", "the ring's two ellipses", "ring.png", ring, colours::kGreen);
  if (stages.above.empty()) return;
  album.plain("figure 6", "above the local threshold (5)", "above.png", stages.above);
  const std::array<const char*, 4> names = {"after morphology", "after the rule of area",
                                            "after the rule of aspect ratio", "after the rule of filling"};
  for (std::size_t k = 0; k < names.size(); ++k) {
    album.drawn("figure 6", names[k], "regions" + std::to_string(k) + ".png", stages.regions[k], colours::kGreen);
  }
}

}  // namespace pharos::tools::paper000
