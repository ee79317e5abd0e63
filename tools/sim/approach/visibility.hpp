// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "tools/sim/approach/approach_scenario.hpp"
#include "tools/sim/random_stream.hpp"

namespace pharos::sim {

enum class Sight : std::uint8_t {
  kSeen,
  kBlind,    // in range, no answer: outage, missed, sun
  kOutside,  // out of range or field, or turned away
};

/// Factor of a source's noise by the sun's glare, 1 without; 5 at the edge of blindness.
double noise_ratio(const ApproachScenario& scenario, std::size_t source, double time_s);

/// Whether a source answers, over time.
class Visibility {
 public:
  Visibility(const ApproachScenario& scenario, std::size_t source, std::uint64_t seed);
  /// Times must not decrease. T_sensor_target is the true pose.
  Sight at(double time_s, const Pose<frame::Sensor, frame::CommonTarget>& T_sensor_target);

 private:
  bool in_outage(double time_s);
  double exponential(double mean);

  const ApproachScenario& scenario_;
  std::size_t index_;
  RandomStream random_, missed_random_;
  double outage_from_s_, outage_to_s_;
};

}  // namespace pharos::sim
