// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/approach/visibility.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pharos/base/units.hpp"

namespace pharos::sim {
namespace {

constexpr double kNoiseAtBlindness = 5.0;

double sun_angle_deg(const SunPassage& sun, double time_s) {
  return std::hypot(sun.miss_deg, sun.rate_deg_s * (time_s - sun.centre_s));
}

bool concerns(const SunPassage& sun, const std::string& name) {
  return std::find(sun.sources.begin(), sun.sources.end(), name) != sun.sources.end();
}

double angle_deg(const Vector3& a, const Vector3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)) * kDegPerRad; }

}  // namespace

double noise_ratio(const ApproachScenario& scenario, std::size_t source, double time_s) {
  double ratio = 1.0;
  for (const SunPassage& sun : scenario.suns) {
    if (!concerns(sun, scenario.sources[source].name)) continue;
    const double angle = sun_angle_deg(sun, time_s);
    const double depth = std::clamp((sun.glare_deg - angle) / (sun.glare_deg - sun.blind_deg), 0.0, 1.0);
    ratio = std::max(ratio, 1.0 + (kNoiseAtBlindness - 1.0) * depth * depth);
  }
  return ratio;
}

Visibility::Visibility(const ApproachScenario& scenario, std::size_t source, std::uint64_t seed)
    : scenario_(scenario),
      index_(source),
      random_(seed, "outages " + scenario.sources[source].name),
      missed_random_(seed, "missed " + scenario.sources[source].name) {
  const double rate = scenario.sources[source].outages_per_minute;
  outage_from_s_ = rate > 0.0 ? exponential(60.0 / rate) : std::numeric_limits<double>::infinity();
  outage_to_s_ = outage_from_s_ + exponential(scenario.sources[source].outage_s);
}

double Visibility::exponential(double mean) { return -mean * std::log(1.0 - random_.uniform()); }

bool Visibility::in_outage(double time_s) {
  const ApproachSource& source = scenario_.sources[index_];
  while (time_s > outage_to_s_) {
    outage_from_s_ = outage_to_s_ + exponential(60.0 / source.outages_per_minute);
    outage_to_s_ = outage_from_s_ + exponential(source.outage_s);
  }
  return time_s >= outage_from_s_;
}

Sight Visibility::at(double time_s, const Pose<frame::Sensor, frame::CommonTarget>& T_sensor_target) {
  const ApproachSource& source = scenario_.sources[index_];
  const bool missed = missed_random_.chance(source.missed_ratio);
  const bool outage = in_outage(time_s);
  const Vector3& t = T_sensor_target.t;
  const double range_m = t.norm();
  if (range_m < source.min_range_m || range_m > source.max_range_m) return Sight::kOutside;
  if (angle_deg(t, Vector3::UnitZ()) > source.half_field_deg) return Sight::kOutside;
  if (angle_deg(T_sensor_target.R.col(2), -t) > source.max_incidence_deg) return Sight::kOutside;
  for (const SunPassage& sun : scenario_.suns) {
    if (concerns(sun, source.name) && sun_angle_deg(sun, time_s) < sun.blind_deg) return Sight::kBlind;
  }
  return missed || outage ? Sight::kBlind : Sight::kSeen;
}

}  // namespace pharos::sim
