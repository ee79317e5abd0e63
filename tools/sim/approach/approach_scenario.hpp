// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/mounting/mounting.hpp"

namespace pharos::sim {

// A scenario of `pharos sim approach`: what a TOML file says (read_approach_scenario), or what a program fills in.
// Every default is that of the file; README.md lists keys and units.

/// How the target moves in the vehicle's frame (z ahead).
struct ApproachMotion {
  enum class Form : std::uint8_t {
    kApproach,   // from start_m to end_m, the target tumbling free of torque, its ring towards the vehicle
    kManoeuvre,  // for calibration: the target sways and turns about start_m ahead
  };
  Form form = Form::kApproach;
  double duration_s = 300.0;
  double start_m = 20.0;
  double end_m = 0.4;
  double sway_m = 0.3;         // lateral amplitude at start_m, in proportion to the distance; of a manoeuvre all axes
  double turn_deg = 25.0;      // of a manoeuvre: amplitude of the rotation vector, each axis
  double rate_deg_s = 1.0;     // tumbling: magnitude of the rate
  double nutation_deg = 4.0;   // of the ring's axis about the angular momentum, which points at the vehicle
  double inertia_ratio = 0.7;  // axial over transverse moment of inertia
  double centre_of_mass_m = 0.6;   // behind the target frame's origin, along its z axis
  double attitude_sway_deg = 0.2;  // of the vehicle: amplitude of the rotation vector, each axis
};

/// Standard deviations at `range_m`; they grow with (range / range_m)^power, but not below `floor` of these.
struct RangeNoise {
  double range_m = 3.0;
  double power = 2.0;
  double floor = 0.1;
  double tilt_deg = 0.1;    // each of the two directions across the feature's axis
  double turn_deg = 0.1;    // about the feature's axis
  double lateral_mm = 1.0;  // each of the two directions across the line of sight
  double depth_mm = 3.0;    // along it
};

/// Slow error, first-order Gauss-Markov in the sensor's frame: standard deviation of each axis at RangeNoise::range_m;
/// it grows with the range as the noise does.
struct SlowBias {
  double rotation_deg = 0.02;
  double position_mm = 0.5;
  double time_constant_s = 60.0;
};

struct ApproachSource {
  std::string name;
  host::SourceKind kind = host::SourceKind::kLighthouse;
  bool given = false;  // its mounting and feature frame define vehicle and target frame: no errors in mounting.toml
  host::VehicleFromSensor T_vehicle_sensor;
  host::TargetFromFeature T_target_feature;  // of slam: ignored
  double rate_hz = 10.0;
  double delay_s = 0.0;         // from the measurement to its arrival
  double delay_jitter_s = 0.0;  // added, uniform
  double time_offset_s = 0.0;   // vehicle time = the source's time + offset
  double min_range_m = 0.0, max_range_m = 100.0;
  double half_field_deg = 40.0;     // of the sensor's z axis
  double max_incidence_deg = 70.0;  // of the target's z axis to the line of sight; 180: seen from all sides
  bool has_turn = true;
  RangeNoise noise;
  SlowBias bias;
  double scale_sigma = 0.0;
  double drift_deg_per_sqrt_s = 0.0, drift_mm_per_sqrt_s = 0.0;  // random walk since the first measurement: slam
  std::optional<double> ambiguous_beyond_m;                      // poses further away have a second solution
  double missed_ratio = 0.0;
  double outages_per_minute = 0.0, outage_s = 1.0;  // no answer; exponential length with this mean
  // 1 sigma of each axis of the errors in mounting.toml.
  double mounting_sigma_deg = 0.02, mounting_sigma_mm = 0.5;
  double feature_sigma_deg = 0.02, feature_sigma_mm = 0.5;
  double time_sigma_s = 3e-4;
};

/// The sun passes through the field of the cameras named.
struct SunPassage {
  double centre_s = 0.0;
  double rate_deg_s = 0.5;
  double miss_deg = 0.0;    // nearest angle to the optical axis
  double glare_deg = 25.0;  // noise grows within, fivefold at blind_deg
  double blind_deg = 8.0;   // no answer within
  std::vector<std::string> sources;
};

enum class ApproachFaultKind : std::uint8_t {
  kStep,         // amount: sigmas of the pose's own covariance, in a random direction
  kRamp,         // the same, reached after ramp_s
  kFreeze,       // the last pose again, with new times
  kWrongTime,    // amount: s added to the times
  kScale,        // amount: positions are (1 + amount) times too large
  kMirrored,     // the mirrored attitude, as if it were the only one
  kWrongTarget,  // another body, 0.8 m aside, turned by 40 deg and moving at 5 mm/s
  kBurst,        // half of the poses wrong by amount sigmas, each in a random direction
};
const char* word_of(ApproachFaultKind kind);

struct ApproachFault {
  std::string source;
  ApproachFaultKind kind = ApproachFaultKind::kStep;
  double at_low_s = 0.0, at_high_s = 0.0;  // drawn between
  double for_s = 10.0;
  double amount_low = 0.0, amount_high = 0.0;  // drawn between
  double ramp_s = 20.0;
};

struct ApproachScenario {
  ApproachMotion motion;
  double truth_step_s = 1e-3;
  double from_s = 0.0, to_s = 1e9;  // no source measures outside, true times
  std::vector<ApproachSource> sources;
  std::vector<SunPassage> suns;
  std::vector<ApproachFault> faults;

  /// Null where no source has this name.
  const ApproachSource* find(const std::string& name) const;
};

/// What a source of this kind is unless the scenario says otherwise.
ApproachSource usual_source(host::SourceKind kind);

/// Reads a scenario (`-` is standard input). Throws host::InputError naming file, line and key.
ApproachScenario read_approach_scenario(const std::string& path);
ApproachScenario parse_approach_scenario(std::string_view text, const std::string& name);

}  // namespace pharos::sim
