// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "tools/evaluate/comparison.hpp"
#include "tools/sim/random_stream.hpp"
#include "tools/sim/trajectory.hpp"

namespace pharos::evaluate {

/// Transformation that a test puts between ESTIMATE and TRUTH: the paper's frame (002, section 4.3), a marker body, a
/// clock.
inline Alignment planted_alignment() {
  return {{rotation_exp({-1.4620, 1.3741, -1.0023}), {0.680, 0.624, 2.884}},
          {rotation_exp({0.3, -0.2, 0.5}), {0.05, -0.03, 0.04}},
          1234.56789};
}

/// Noise of ESTIMATE.
struct PlantedNoise {
  double sigma_rad = 0.0;      // each axis
  double sigma_m = 0.0;        // each axis
  double wild_fraction = 0.0;  // of poses in another minimum
  double stated_scale = 1.0;   // stated sigma per real sigma
};

/// `seconds` of ESTIMATE at 120 Hz along `motion`, and TRUTH at 500 Hz, slightly longer at both ends.
struct Planted {
  TrajectoryFile<EstimatePose> estimate;
  TrajectoryFile<TruthPose> truth;
};

template <class WorldFromBody>
void count_rows(TrajectoryFile<WorldFromBody>& file) {
  file.rows = file.samples.size();
  file.first_s = file.samples.front().time_s;
  file.last_s = file.samples.back().time_s;
}

inline EstimatePose disturbed(const EstimatePose& pose, const PlantedNoise& noise, sim::RandomStream& random) {
  Vector6 delta;
  for (int k = 0; k < 3; ++k) delta[k] = noise.sigma_rad * random.normal();
  for (int k = 3; k < 6; ++k) delta[k] = noise.sigma_m * random.normal();
  if (random.uniform(0.0, 1.0) < noise.wild_fraction) delta[0] += 0.7, delta[5] += 0.1;
  return pose.moved_by(delta);
}

inline Planted plant(const sim::Trajectory& motion, double seconds, const Alignment& hidden,
                     const PlantedNoise& noise) {
  sim::RandomStream random(1, "planted");
  Planted planted;
  for (double t = 0.0; t <= seconds; t += 1.0 / 120.0) {
    const auto at = motion.at(t);
    Sample<EstimatePose> sample{t, disturbed({at.R, at.t}, noise, random), {}, {}};
    if (noise.sigma_rad > 0.0) sample.sigma_rotation_rad = std::sqrt(3.0) * noise.stated_scale * noise.sigma_rad;
    if (noise.sigma_m > 0.0) sample.sigma_position_m = std::sqrt(3.0) * noise.stated_scale * noise.sigma_m;
    planted.estimate.samples.push_back(sample);
  }
  for (double t = -0.1; t <= seconds + 0.1; t += 0.002) {
    const auto at = motion.at(t);
    const TruthPose pose = hidden.world.inverse() * EstimatePose{at.R, at.t} * hidden.body.inverse();
    planted.truth.samples.push_back({t + hidden.time_offset_s, pose, {}, {}});
  }
  count_rows(planted.estimate);
  count_rows(planted.truth);
  return planted;
}

inline std::unique_ptr<sim::Trajectory> manoeuvre(double seconds) {
  return sim::make_random_manoeuvre({}, seconds, sim::RandomStream(3, "manoeuvre"));
}

}  // namespace pharos::evaluate
