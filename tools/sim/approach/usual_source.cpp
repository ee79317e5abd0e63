// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/approach/approach_scenario.hpp"

namespace pharos::sim {
namespace {

using host::SourceKind;

// Half a turn about x: a feature frame whose z axis points out of the target is seen by a sensor that looks along z.
ApproachSource lighthouse() {
  ApproachSource source;
  source.given = true;
  source.T_vehicle_sensor = {Matrix3::Identity(), {0.0, -0.15, 0.0}};
  source.rate_hz = 30.0;
  source.delay_s = 0.003;
  source.max_range_m = 6.0;
  source.half_field_deg = 50.0;
  source.max_incidence_deg = 55.0;
  // `pharos track` with 12 sensors at 3 m: about 0.1 deg, 1 mm across and 5 mm along the line of sight.
  source.noise = {3.0, 2.0, 0.1, 0.10, 0.05, 0.5, 4.0};
  source.bias = {0.02, 0.4, 30.0};
  source.ambiguous_beyond_m = 5.5;
  return source;
}

ApproachSource tof() {
  ApproachSource source;
  source.T_vehicle_sensor = {rotation_exp({0.03, -0.02, 0.5}), {0.20, 0.10, -0.05}};
  source.T_target_feature = {rotation_exp({0.0, 0.01, 0.7}), {0.05, 0.25, 0.03}};
  source.rate_hz = 10.0;
  source.delay_s = 0.06;
  source.delay_jitter_s = 0.03;
  source.time_offset_s = -0.021;
  source.max_range_m = 6.0;
  source.min_range_m = 0.5;
  source.half_field_deg = 29.0;
  source.max_incidence_deg = 45.0;
  // Paper 000, table 3, one frame at 4.16 m: 0.27, 0.24, 2.84 mm; 0.33, 0.49, 0.12 deg.
  source.noise = {4.16, 2.0, 0.1, 0.40, 0.12, 0.26, 2.8};
  source.bias = {0.03, 0.3, 30.0};
  return source;
}

ApproachSource ring2() {
  ApproachSource source;
  source.T_vehicle_sensor = {rotation_exp({-0.04, 0.03, 0.01}), {-0.25, 0.05, 0.0}};
  source.T_target_feature = {rotation_exp({0.01, -0.01, 0.2}), {0.04, 0.26, 0.02}};
  source.rate_hz = 5.0;
  source.delay_s = 0.12;
  source.delay_jitter_s = 0.03;
  source.time_offset_s = 0.034;
  source.min_range_m = 1.6;
  source.max_range_m = 5.0;
  source.half_field_deg = 30.0;
  source.max_incidence_deg = 60.0;
  source.has_turn = false;
  source.noise = {3.0, 2.0, 0.1, 0.10, 0.0, 0.3, 2.0};
  source.bias = {0.02, 0.3, 30.0};
  return source;
}

ApproachSource slam() {
  ApproachSource source;
  source.T_vehicle_sensor = {rotation_exp({0.02, 0.05, -0.03}), {-0.25, 0.05, 0.0}};
  source.rate_hz = 10.0;
  source.delay_s = 0.09;
  source.delay_jitter_s = 0.04;
  source.time_offset_s = 0.012;
  source.half_field_deg = 35.0;
  source.max_incidence_deg = 180.0;
  source.noise = {10.0, 2.0, 0.02, 0.10, 0.10, 3.0, 15.0};
  source.bias = {0.0, 0.0, 60.0};
  source.scale_sigma = 1e-3;
  source.drift_deg_per_sqrt_s = 0.002;
  source.drift_mm_per_sqrt_s = 0.05;
  return source;
}

}  // namespace

ApproachSource usual_source(SourceKind kind) {
  ApproachSource source = kind == SourceKind::kLighthouse ? lighthouse()
                          : kind == SourceKind::kTof      ? tof()
                          : kind == SourceKind::kRing2    ? ring2()
                                                          : slam();
  source.kind = kind;
  source.name = host::word_of(kind);
  return source;
}

}  // namespace pharos::sim
