// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/integrity/ring2_kind.hpp"

#include <cmath>

#include "host/vision/ring2/ring2_detector.hpp"
#include "pharos/base/units.hpp"
#include "tools/evaluation/reproduce/ring2/simulated_pair.hpp"
#include "tools/sim/ring2/ring2_scenario.hpp"
#include "tools/sim/ring2/ring2_writer.hpp"

namespace pharos::tools {
namespace {

constexpr double kTolerance_deg = 1.0, kTolerance_mm = 10.0;
constexpr double kMaxTilt_rad = 0.45;

// One pose of one body: sizes, place, tilt and sun at random.
sim::Ring2Scenario scenario_of(std::uint64_t seed) {
  sim::RandomStream random(seed, "ring2 body");
  sim::Ring2Scenario scenario;
  scenario.rig = sim::symmetric_rig(1.8, 20.0 * kRadPerDeg, 1000.0, 1280, 1024);
  scenario.target.ring_radius_m = random.uniform(0.4, 0.6);
  scenario.target.nozzle_radius_m = scenario.target.ring_radius_m * random.uniform(0.2, 0.35);
  scenario.target.distance_m = scenario.target.ring_radius_m * random.uniform(0.5, 1.0);
  const auto tilt = [&] { return random.uniform(-kMaxTilt_rad, kMaxTilt_rad) * kDegPerRad; };
  scenario.poses = {{{random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), random.uniform(2.6, 3.4)}, tilt(), tilt()}};
  scenario.sun_direction = Vector3(random.uniform(-0.7, 0.7), random.uniform(-0.7, 0.7), -0.8).normalized();
  return scenario;
}

double angle_deg(const Vector3& a, const Vector3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)) * kDegPerRad; }

IntegrityTrial trial_of(std::uint64_t seed) {
  const sim::Ring2Scenario scenario = scenario_of(seed);
  const std::array<host::GreyImage, 2> images{sim::ring2_image(scenario, 0, 0, seed),
                                              sim::ring2_image(scenario, 0, 1, seed)};
  host::Ring2Detector detector(ring2::core_rig(scenario.rig), {});
  const host::Ring2Detection found = detector.find({images[0].view(), images[1].view()});
  IntegrityTrial trial;
  if (!found.estimate) {
    trial.status = "refused_" + found.refusal;
    return trial;
  }
  const ring2::Ring2Estimate& e = *found.estimate;
  trial.status = e.ambiguous() ? "ambiguous" : "ok";
  const sim::RingAndNozzle truth = scenario.target_at(0);
  trial.deviations.push_back(
      {"attitude, deg", angle_deg(e.normal, truth.normal), e.sigma_normal_rad() * kDegPerRad, kTolerance_deg});
  if ((e.unobservable & (ring2::kUnobservableRing | ring2::kUnobservableScale)) == 0) {
    trial.deviations.push_back({"position, mm", kMmPerM * (e.ring_centre_m - truth.ring_centre_m).norm(),
                                kMmPerM * std::sqrt(e.covariance.block<3, 3>(2, 2).trace()), kTolerance_mm});
  }
  return trial;
}

}  // namespace

IntegrityKind ring2_kind() {
  return {"ring2", "ring and nozzle are in both images, tilted by up to 26 deg", trial_of,
          [](std::uint64_t seed, const std::filesystem::path& folder) {
            sim::write_ring2_pairs(scenario_of(seed), seed, folder.string(), [] {});
          }};
}

}  // namespace pharos::tools
