// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/ring2/centre_images.hpp"

#include <array>
#include <string>

#include "tools/evaluation/reproduce/ring2/paper_scene.hpp"
#include "tools/plot/svg.hpp"

namespace pharos::tools {
namespace {

constexpr std::array<const char*, 2> kViewNames = {"left", "right"};
constexpr std::array<const char*, 2> kCircleNames = {"ring", "nozzle"};
constexpr double kScale = 0.4;  // picture units of a pixel
constexpr double kGap = 20.0;
constexpr double kTop = 30.0;

sim::SpaceCircle circle_of(const ring2::Scene& scene, std::size_t k) {
  return k == 0 ? scene.target.ring() : scene.target.nozzle();
}

void cross(Svg& svg, PlotPoint at, const char* colour) {
  constexpr double kHalf = 5.0;
  svg.line({at.x - kHalf, at.y}, {at.x + kHalf, at.y}, colour);
  svg.line({at.x, at.y - kHalf}, {at.x, at.y + kHalf}, colour);
}

void draw_view(Svg& svg, const ring2::Scene& scene, std::size_t v) {
  const sim::StereoCamera& camera = scene.rig[v];
  const double left = static_cast<double>(v) * (camera.width_px * kScale + kGap);
  const auto at = [&](double u, double w) { return PlotPoint{left + u * kScale, kTop + w * kScale}; };
  const double right = camera.width_px, bottom = camera.height_px;
  svg.polyline({at(0, 0), at(right, 0), at(right, bottom), at(0, bottom), at(0, 0)}, "#404040");
  svg.text({left, kTop - 10.0}, std::string(kViewNames[v]) + " image");
  for (std::size_t k = 0; k < kCircleNames.size(); ++k) {
    const sim::SpaceCircle circle = circle_of(scene, k);
    std::vector<PlotPoint> outline;
    for (const Vector2& p : sim::contour_points(camera, circle, 180)) outline.push_back(at(p.x(), p.y()));
    outline.push_back(outline.front());
    svg.polyline(outline, "#3c82dc", 1.5);
    const auto middle = sim::projected_ellipse(camera, circle);
    const auto centre = sim::pixel_of(camera, circle.centre_m);
    if (middle) cross(svg, at(middle->cx_px, middle->cy_px), "#e1501e");
    if (centre) cross(svg, at(centre->x(), centre->y()), "#00a060");
  }
}

}  // namespace

void add_centre_images(report::PartResult& result, const std::filesystem::path& folder) {
  const std::array<ring2::Scene, 2> scenes = {paper_scene(0.0, 1.0), paper_scene(1.0, 0.0)};
  const std::array<const char*, 2> labels = {"figure 7a", "figure 7b"};
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    for (std::size_t v = 0; v < kViewNames.size(); ++v) {
      for (std::size_t k = 0; k < kCircleNames.size(); ++k) {
        const auto middle = sim::projected_ellipse(scenes[s].rig[v], circle_of(scenes[s], k));
        const auto centre = sim::pixel_of(scenes[s].rig[v], circle_of(scenes[s], k).centre_m);
        if (!middle || !centre) continue;
        result.rows.push_back({labels[s],
                               std::string(kViewNames[v]) + " image, " + kCircleNames[k] +
                                   ": the ellipse's middle from the image of the circle's centre",
                               "px", "not 0", (Vector2(middle->cx_px, middle->cy_px) - *centre).norm(),
                               "projected, without noise"});
      }
    }
    if (folder.empty()) continue;
    const sim::StereoCamera& camera = scenes[s].rig[0];
    Svg svg(2.0 * camera.width_px * kScale + kGap, kTop + camera.height_px * kScale + 10.0);
    for (std::size_t v = 0; v < kViewNames.size(); ++v) draw_view(svg, scenes[s], v);
    const std::string file = std::string("figure7") + (s == 0 ? "a" : "b") + ".svg";
    svg.write((folder / file).string());
    result.pictures.push_back({labels[s],
                               std::string("turned by 1 deg about ") + (s == 0 ? "Y" : "X") +
                                   "; green: image of the circle's centre, red: middle of its ellipse",
                               file});
  }
}

}  // namespace pharos::tools
