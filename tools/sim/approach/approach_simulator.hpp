// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/mounting/mounting.hpp"
#include "tools/sim/approach/approach_scenario.hpp"
#include "tools/sim/approach/approach_truth.hpp"
#include "tools/sim/approach/visibility.hpp"

namespace pharos::sim {

/// When a source measures, and what it could see then.
struct ApproachSight {
  double true_time_s = 0.0;  // on the vehicle's clock
  double time_s = 0.0;       // as stamped by the source
  double arrival_s = 0.0;    // on the vehicle's clock
  Sight sight = Sight::kSeen;
  host::SensorFromFeature pose;  // true
};

/// What a source answers to one measurement.
struct ApproachMeasurement {
  std::size_t source = 0;    // in the scenario's order
  double true_time_s = 0.0;  // of validity, on the vehicle's clock
  double time_s = 0.0;       // as stamped by the source
  double arrival_s = 0.0;    // on the vehicle's clock
  bool seen = true;          // false: refused, nothing below has a meaning
  bool has_turn = true;      // false: R is one of the rotations with this z axis
  host::SensorFromFeature pose;
  Matrix6 covariance = Matrix6::Zero();  // as stated: of the white noise alone
  std::optional<host::SensorFromFeature> second;
  double delta_chi2 = 0.0;
  bool faulty = false;
};

/// A fault as it was drawn.
struct DrawnFault {
  std::size_t source = 0;
  ApproachFaultKind kind = ApproachFaultKind::kStep;
  double from_s = 0.0, to_s = 0.0;  // true times
  double amount = 0.0;
};

/// One approach: one truth, every source's poses with their errors. The same scenario and seed give the same values.
class ApproachSimulator {
 public:
  ApproachSimulator(const ApproachScenario& scenario, std::uint64_t seed);

  const ApproachScenario& scenario() const { return scenario_; }
  const ApproachTruth& truth() const { return truth_; }
  /// Without error: every value is given.
  const host::Mounting& true_mounting() const { return true_mounting_; }
  /// With the errors of a calibration, drawn from the covariances that it states; of slam without T_target_feature.
  const host::Mounting& calibrated_mounting() const { return calibrated_mounting_; }
  const std::vector<DrawnFault>& faults() const { return faults_; }

  /// Every measurement of one source in order, also those that see nothing.
  std::vector<ApproachSight> sights(std::size_t source) const;
  /// All answers of one source in the order of the measurements. 300 s of four sources take about 0.1 s.
  std::vector<ApproachMeasurement> measure(std::size_t source) const;
  /// All sources in the order of arrival.
  std::vector<ApproachMeasurement> measure_all() const;

 private:
  void make_mountings();
  void draw_faults();

  ApproachScenario scenario_;
  std::uint64_t seed_;
  ApproachTruth truth_;
  host::Mounting true_mounting_, calibrated_mounting_;
  std::vector<DrawnFault> faults_;
};

}  // namespace pharos::sim
