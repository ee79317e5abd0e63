// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/integrity/pointing_kind.hpp"

#include <algorithm>
#include <cmath>

#include "host/vision/pointing/measure_panel.hpp"
#include "pharos/base/units.hpp"
#include "tools/sim/pointing/pointing_image.hpp"
#include "tools/sim/pointing/pointing_views.hpp"
#include "tools/sim/pointing/pointing_writer.hpp"

namespace pharos::tools {
namespace {

constexpr double kTolerance_deg = 1.0;

// One view of one satellite: sizes, range and attitude at random.
sim::PointingScenario scenario_of(std::uint64_t seed) {
  sim::RandomStream random(seed, "line body");
  sim::PointingScenario scenario;
  scenario.satellite.panel_length_m = random.uniform(4.0, 12.0);
  scenario.satellite.panel_width_m = random.uniform(1.5, 3.0);
  scenario.satellite.body_m = {random.uniform(1.0, 3.0), random.uniform(1.0, 3.0), random.uniform(1.0, 3.0)};
  sim::RandomPointingViews limits;
  limits.count = 1;
  limits.range_m = 100.0 * random.uniform(1.0, 3.0) * scenario.satellite.panel_length_m / 6.0;
  scenario.views = sim::random_views(limits, sim::RandomStream(seed, "line views"));
  return scenario;
}

IntegrityTrial trial_of(std::uint64_t seed) {
  const sim::PointingScenario scenario = scenario_of(seed);
  const host::GreyImage image = sim::pointing_image(scenario, 0, seed);
  IntegrityTrial trial;
  const auto panel = pointing::measure_panel(image.view(), sim::optics_as<PinholeCamera>(scenario.camera));
  if (!panel) {
    trial.status = std::string("refused_") + pointing::name_of(panel.error());
    return trial;
  }
  const sim::PointingView& view = scenario.views[0];
  const pointing::PointingResult answer = pointing::answer_of(*panel, {view.azimuth_rad, view.elevation_rad});
  trial.status = "ok";
  const Vector3 truth = view.R_station_body.col(0);
  const double error_deg = std::asin(std::min(1.0, answer.axis.axis.cross(truth).norm())) * kDegPerRad;
  trial.deviations.push_back({"axis, deg", error_deg, answer.axis.sigma_rad() * kDegPerRad, kTolerance_deg});
  return trial;
}

}  // namespace

IntegrityKind pointing_kind() {
  return {"line", "two panels are in the image, more than 30 deg off the line of sight", trial_of,
          [](std::uint64_t seed, const std::filesystem::path& folder) {
            sim::write_pointing_images(scenario_of(seed), seed, folder, [] {});
          }};
}

}  // namespace pharos::tools
