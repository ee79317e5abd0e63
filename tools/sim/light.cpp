// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/light.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/base/units.hpp"

namespace pharos::sim {
namespace {

constexpr double kTicksPer48 = 50.0 / 48.0;

double min_cosine(const LightScenario& light) { return std::cos(light.max_incidence_deg * kRadPerDeg); }

// Whether the straight line from a sensor to the station passes through the body. Faces through the sensor itself are
// left out by starting a tenth of a millimetre away from it.
bool body_in_the_way(const std::vector<BodyFace>& body, const Vector3& sensor, const Vector3& to_station,
                     double range_m) {
  double enter = 1e-4;
  double leave = range_m;
  for (const BodyFace& face : body) {
    const double speed = face.normal.dot(to_station);
    const double outside = face.normal.dot(sensor) - face.offset_m;
    if (std::abs(speed) < 1e-12) {
      if (outside > 0.0) return false;
    } else if (speed > 0.0) {
      leave = std::min(leave, -outside / speed);
    } else {
      enter = std::max(enter, -outside / speed);
    }
  }
  return !body.empty() && leave > enter;
}

}  // namespace

Illumination illuminate(const LighthouseFromBody& T_L_B, const SensorPlacement& sensor, const LightScenario& light,
                        const std::vector<BodyFace>& body) {
  const Vector3 p = T_L_B * sensor.position_m;
  Illumination seen;
  seen.range_m = p.norm();
  const double reach = p.z() * std::tan(light.half_field_deg * kRadPerDeg);
  if (p.z() <= 0.0 || std::abs(p.x()) > reach || std::abs(p.y()) > reach || seen.range_m > light.max_range_m) {
    return seen;
  }
  const Vector3 to_station = -(T_L_B.R.transpose() * p) / seen.range_m;
  if (sensor.has_normal()) seen.cosine = sensor.normal.normalized().dot(to_station);
  seen.lit = seen.cosine > min_cosine(light) && !body_in_the_way(body, sensor.position_m, to_station, seen.range_m);
  return seen;
}

double flash_excess_ticks(const Illumination& seen, const LightScenario& light) {
  const double amplitude = seen.cosine / (seen.range_m * seen.range_m);
  const double excess = std::clamp((75.0 + 37.3 * std::log(amplitude)) * kTicksPer48, -62.0, 78.0);
  const double margin = std::min((seen.cosine - min_cosine(light)) / 0.15, 1.0);
  return excess - 800.0 * kTicksPer48 * (1.0 - margin) * (1.0 - margin);
}

double hit_width_ticks(const Illumination& seen, const LightScenario& light) {
  const double minimum = min_cosine(light);
  const double square_on = std::sqrt(std::max((seen.cosine - minimum) / (1.0 - minimum), 0.0));
  const double width = 200.0 * kTicksPer48 * (2.9 / seen.range_m) * (0.15 + 0.85 * square_on);
  return std::clamp(width, 27.0 * kTicksPer48, 1326.0 * kTicksPer48);
}

double nominal_flash_ticks(Rotor rotor, bool data, bool skip) {
  return (3000.0 + (rotor == Rotor::kY ? 500.0 : 0.0) + (data ? 1000.0 : 0.0) + (skip ? 2000.0 : 0.0)) * kTicksPer48;
}

}  // namespace pharos::sim
