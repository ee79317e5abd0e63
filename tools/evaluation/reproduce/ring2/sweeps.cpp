// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/ring2/sweeps.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/base/units.hpp"
#include "pharos/ring2/paper_method.hpp"
#include "tools/evaluation/reproduce/ring2/simulated_pair.hpp"

namespace pharos::tools {
namespace {

using ring2::Scene;

// Section 3 of the paper: 1.12 m and 0.297 m across, 0.5 m apart, f = 600.
constexpr double kFocal_px = 600.0;
constexpr double kRange_m = 3.0;
constexpr double kBaseline_m = 1.8;
constexpr double kToeIn_deg = 20.0;
constexpr double kMaxAttitude_deg = 25.0;

Scene scene_of(double theta_deg, double gamma_deg, double range_m = kRange_m, double baseline_m = kBaseline_m,
               double toe_in_deg = kToeIn_deg) {
  Scene scene;
  scene.rig = sim::symmetric_rig(baseline_m, toe_in_deg * kRadPerDeg, kFocal_px, 1280, 1024);
  scene.target.normal = sim::facing_normal(theta_deg * kRadPerDeg, gamma_deg * kRadPerDeg);
  scene.target.ring_centre_m = {0.0, 0.0, range_m};
  return scene;
}

struct Sweep {
  const char* figure;
  const char* what;
  const char* published;
  std::vector<Scene> scenes;
};

std::vector<Sweep> sweeps_of(std::uint64_t seed) {
  std::vector<Sweep> sweeps = {
      {"figure 8a", "baseline 2.6 to 1.0 m", "< 1", {}},      {"figure 8b", "toe-in 30 to 0 deg", "< 1", {}},
      {"section 3", "range 3.0 to 1.6 m", "< 1", {}},         {"figure 9a", "turn about Y, 0 to 5 deg", "< 0.5", {}},
      {"figure 9b", "turn about X, 0 to 5 deg", "< 0.5", {}}, {"figure 10", "both, 50 random to 5 deg", "< 0.5", {}}};
  // The rig sweeps at the attitude of figure 7.
  for (int mm = 2600; mm >= 1000; mm -= 50) sweeps[0].scenes.push_back(scene_of(1.0, 1.0, kRange_m, mm * 1e-3));
  for (int deg = 30; deg >= 0; --deg) sweeps[1].scenes.push_back(scene_of(1.0, 1.0, kRange_m, kBaseline_m, deg));
  for (int mm = 3000; mm >= 1600; mm -= 50) sweeps[2].scenes.push_back(scene_of(1.0, 1.0, mm * 1e-3));
  for (int tenth = 0; tenth <= 50; ++tenth) {
    sweeps[3].scenes.push_back(scene_of(0.0, tenth * 0.1));
    sweeps[4].scenes.push_back(scene_of(tenth * 0.1, 0.0));
  }
  sim::RandomStream random(seed, "figure 10");
  for (int k = 0; k < 50; ++k) {
    const double theta_deg = random.uniform(-5.0, 5.0);
    sweeps[5].scenes.push_back(scene_of(theta_deg, random.uniform(-5.0, 5.0)));
  }
  return sweeps;
}

double angle_deg(const Vector3& a, const Vector3& b) { return kDegPerRad * std::atan2(a.cross(b).norm(), a.dot(b)); }

struct Errors {
  double paper_deg = 0.0;
  double one_camera_deg = 0.0;
  double exact_deg = 0.0;
  double paper_sum_deg = 0.0;
  double one_camera_sum_deg = 0.0;
};

// A method without an answer is off by half a turn.
Errors errors_of(const std::vector<Scene>& scenes) {
  constexpr double kNoAnswer_deg = 180.0;
  Errors errors;
  for (const Scene& scene : scenes) {
    const ring2::Rig rig = ring2::core_rig(scene.rig);
    const ring2::ContourSet contours = ring2::clean_contours(scene);
    const Vector3& truth = scene.target.normal;
    const auto exact = ring2::solve_ring2(rig, contours);
    const auto paper = ring2::solve_ring2_by_paper(rig, contours);
    const auto one = ring2::attitude_by_one_camera(
        rig.views[0], *contours[0][0], *contours[0][1],
        {scene.target.ring_radius_m, scene.target.nozzle_radius_m, scene.target.distance_m});
    const double paper_deg = paper ? angle_deg(paper->normal, truth) : kNoAnswer_deg;
    const double one_deg = one ? angle_deg(ring2::normal_of(*one), truth) : kNoAnswer_deg;
    errors.exact_deg = std::max(errors.exact_deg, exact ? angle_deg(exact->normal, truth) : kNoAnswer_deg);
    errors.paper_deg = std::max(errors.paper_deg, paper_deg);
    errors.one_camera_deg = std::max(errors.one_camera_deg, one_deg);
    errors.paper_sum_deg += paper_deg;
    errors.one_camera_sum_deg += one_deg;
  }
  return errors;
}

}  // namespace

std::vector<ComparisonRow> reproduce_ring2_sweeps(std::uint64_t seed) {
  std::vector<ComparisonRow> rows;
  double paper_deg = 0.0;
  double one_camera_deg = 0.0;
  for (const Sweep& sweep : sweeps_of(seed)) {
    const Errors errors = errors_of(sweep.scenes);
    const std::string what = sweep.what;
    rows.push_back(
        {sweep.figure, what + ": paper's method, largest error", "deg", sweep.published, errors.paper_deg, ""});
    rows.push_back({sweep.figure, what + ": one camera, largest error", "deg", "", errors.one_camera_deg,
                    "ellipse centres taken for circle centres, sizes known"});
    rows.push_back({sweep.figure, what + ": exact, largest error", "deg", "<= 1e-6", errors.exact_deg, ""});
    if (std::string(sweep.figure).substr(0, 8) != "figure 9") continue;
    paper_deg += errors.paper_sum_deg;
    one_camera_deg += errors.one_camera_sum_deg;
  }
  rows.push_back({"figure 9", "two cameras better than one by", "%", "31.27",
                  100.0 * (1.0 - paper_deg / one_camera_deg),
                  "mean error over both sweeps; the paper's curves are lost"});
  return rows;
}

std::vector<ComparisonRow> reproduce_ring2_noise(int problems, std::uint64_t seed) {
  std::vector<ComparisonRow> rows;
  for (const double sigma_px : {0.1, 0.5}) {
    double exact_sum = 0.0, paper_sum = 0.0, stated_sum = 0.0;
    int answered = 0;
    for (int k = 0; k < problems; ++k) {
      sim::RandomStream random(seed, "attitude " + std::to_string(k));
      const double theta_deg = random.uniform(-kMaxAttitude_deg, kMaxAttitude_deg);
      const Scene scene = scene_of(theta_deg, random.uniform(-kMaxAttitude_deg, kMaxAttitude_deg));
      const ring2::Rig rig = ring2::core_rig(scene.rig);
      const ring2::ContourSet contours =
          ring2::noisy_contours(scene, sigma_px, seed * 1'000'003U + static_cast<std::uint64_t>(k));
      const auto exact = ring2::solve_ring2(rig, contours);
      const auto paper = ring2::solve_ring2_by_paper(rig, contours);
      if (!exact || !paper) continue;
      ++answered;
      exact_sum += std::pow(angle_deg(exact->normal, scene.target.normal), 2);
      paper_sum += std::pow(angle_deg(paper->normal, scene.target.normal), 2);
      stated_sum += std::pow(kDegPerRad * exact->sigma_normal_rad(), 2);
    }
    const std::string what = sigma_px < 0.2 ? "edges good to 0.1 px" : "edges good to 0.5 px";
    const double per_problem = answered > 0 ? 1.0 / answered : 0.0;
    rows.push_back({"noise", what + ": exact, RMS", "deg", sigma_px < 0.2 ? "<= 0.008" : "<= 0.04",
                    std::sqrt(exact_sum * per_problem), "attitudes to 25 deg, 3 m, a point a pixel"});
    rows.push_back({"noise", what + ": exact, RMS over stated sigma", "", "1", std::sqrt(exact_sum / stated_sum), ""});
    rows.push_back({"noise", what + ": paper's method, RMS", "deg", "", std::sqrt(paper_sum * per_problem),
                    "its own error, beyond its range of attitudes"});
    rows.push_back({"noise", what + ": answered", "%", "", 100.0 * answered / problems, ""});
  }
  return rows;
}

}  // namespace pharos::tools
