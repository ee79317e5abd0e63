// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/lh2/lh2_simulator.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "pharos/base/units.hpp"
#include "tools/sim/light.hpp"
#include "tools/sim/ootx_sender.hpp"
#include "tools/sim/ticks.hpp"

namespace pharos::sim {
namespace {

constexpr double kBitRate_Hz = 6e6;
constexpr double kCrystal_ppm = 15.0;  // of stations' clocks, 1 sigma
constexpr double kHitSearchEnd_s = 1e-12;
constexpr int kHitSearchSteps = 12;
// Receivers of the captures: the data begins before the envelope and outlasts it; there it is unreliable.
constexpr double kDataBefore_s = 2.0e-6;
constexpr double kDataAfter_s = 0.5e-6;
constexpr double kLostAtEnds = 0.35;        // of changes outside the envelope
constexpr double kShortestLevel_s = 35e-9;  // shorter levels do not pass a receiver
constexpr double kNoisePulse_s = 0.957e-6;  // noise of a receiver: one pulse of this length

}  // namespace

Lh2Simulator::Lh2Simulator(LighthouseScenario scenario, std::uint64_t seed)
    : scenario_(std::move(scenario)),
      clock_(scenario_.clock.start_ticks, scenario_.clock.offset_ppm, scenario_.clock.drift_ppm_per_s),
      timing_(seed, "lh2 timing"),
      noise_(seed, "hit noise"),
      fault_random_(seed, "faults") {
  draw_stations(seed);
  draw_target(seed);
  draw_hands();
  receivers_.resize(true_target_.size());
  for (std::size_t i = 0; i < receivers_.size(); ++i) receivers_[i].last_ticks = clock_.stamp(0.0);
}

void Lh2Simulator::draw_stations(std::uint64_t seed) {
  RandomStream typical(seed, "typical calibration");
  RandomStream residual(seed, "calibration residuals");
  RandomStream start(seed, "lh2 start");
  for (const StationScenario& given : scenario_.stations) {
    Lh2SimStation station;
    station.pose = given.pose;
    station.id = given.id;
    station.channel = given.channel;
    station.rate = 1.0 + 1e-6 * (scenario_.rotor.offset_ppm + kCrystal_ppm * start.normal());
    for (std::size_t k = 0; k < 2; ++k) {
      // Ranges of real stations.
      const PlaneErrors drawn{k == 0 ? 0.0 : typical.uniform(-0.007, 0.0),
                              (k == 0 ? -1.0 : 1.0) * typical.uniform(0.043, 0.052),
                              typical.uniform(-0.1, 0.4),
                              typical.uniform(0.0, 2.5),
                              typical.uniform(-0.009, 0.005),
                              typical.uniform(0.3, 3.1),
                              typical.uniform(-0.45, 0.35)};
      station.announced[k] = as_announced(given.calibration ? PlaneErrors{} : drawn);
      station.actual[k] = station.announced[k];
      station.actual[k].phase_rad += scenario_.errors.phase_rad * residual.normal();
      station.actual[k].tilt_rad += scenario_.errors.tilt_rad * residual.normal();
      station.actual[k].gibbous_magnitude_rad += scenario_.errors.gibbous_magnitude_rad * residual.normal();
    }
    const ChannelCode code = channel_code(static_cast<std::size_t>(station.channel));
    Turning turning;
    turning.period_s = code.turn_48MHz / 48e6 / station.rate;
    turning.sync_s = start.uniform(0.0, turning.period_s);
    turning.frame = ootx_frame_bits(lh2_announcement(station));
    turning.bit = static_cast<std::size_t>(start.below(static_cast<int>(turning.frame.size())));
    const auto bits = static_cast<std::size_t>(code.turn_48MHz / 8.0);
    for (std::size_t k = 0; k < 2; ++k) turning.code[k] = light_bits(code.taps[k], bits);
    turning_.push_back(std::move(turning));
    stations_.push_back(station);
  }
}

void Lh2Simulator::draw_target(std::uint64_t seed) {
  RandomStream position(seed, "sensor positions");
  true_target_ = scenario_.target;
  for (SensorPlacement& sensor : true_target_) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      sensor.position_m[axis] += scenario_.errors.sensor_position_m * position.normal();
    }
  }
}

void Lh2Simulator::draw_hands() {
  const FaultScenario& faults = scenario_.faults;
  const int count = fault_random_.poisson(faults.hands_per_s * scenario_.duration_s);
  for (int i = 0; i < count; ++i) {
    const double from_s = fault_random_.uniform(0.0, scenario_.duration_s);
    std::vector<bool> covered;
    for (const SensorPlacement& sensor : true_target_) {
      covered.push_back(fault_random_.chance(faults.hand_fraction));
      if (covered.back()) note(from_s, "hand", -1, sensor.sensor, faults.hand_s);
    }
    hands_.push_back({{from_s, from_s + faults.hand_s}, covered});
  }
}

std::optional<LightChange> Lh2Simulator::next() {
  for (;;) {
    // Everything before the earliest sync still to come is in the queue.
    std::size_t earliest = 0;
    for (std::size_t i = 1; i < turning_.size(); ++i) {
      if (turning_[i].sync_s < turning_[earliest].sync_s) earliest = i;
    }
    const double until_s = turning_[earliest].sync_s;
    const bool more = until_s < scenario_.duration_s;
    if (more && (events_.empty() || events_.top().time_s >= until_s - kDataBefore_s)) {
      simulate_turn(earliest);
      continue;
    }
    if (events_.empty()) return std::nullopt;
    const Event event = events_.top();
    events_.pop();
    if (event.time_s > scenario_.duration_s) continue;
    if (const auto change = take(event)) return change;
  }
}

void Lh2Simulator::simulate_turn(std::size_t s) {
  Turning& turning = turning_[s];
  const double sync_s = turning.sync_s;
  const bool slow_bit = turning.frame[turning.bit];
  turning.bit = (turning.bit + 1) % turning.frame.size();
  turning.sync_s += turning.period_s + seconds(scenario_.rotor.turn_jitter_ticks) * timing_.normal();
  add_noise(noise_until_s_, turning.sync_s);
  noise_until_s_ = std::max(noise_until_s_, turning.sync_s);
  const NoiseScenario& noise = scenario_.noise;
  const double sigma_s = noise.sigma_arcsec * kRadPerArcsec * turning.period_s / kTwoPi;
  for (std::size_t plane = 0; plane < 2; ++plane) {
    const double common_s = sigma_s * std::sqrt(noise.rho) * noise_.normal();
    for (std::size_t i = 0; i < true_target_.size(); ++i) {
      const double own_s = sigma_s * std::sqrt(1.0 - noise.rho) * noise_.normal();
      const auto time_s = hit_time(s, plane, i, sync_s);
      if (!time_s || *time_s > scenario_.duration_s - kDataAfter_s || blocked(i, *time_s)) continue;
      const LighthouseFromBody T = stations_[s].pose.inverse() * scenario_.trajectory->at(*time_s);
      const Illumination seen = illuminate(T, true_target_[i], scenario_.light, scenario_.body);
      if (!seen.lit) continue;
      // 6.7 us at 4 m, 8.2 us nearer (captures); half at the edge of the field.
      const double length_s =
          std::clamp(6.7e-6 * std::sqrt(4.0 / seen.range_m) * (0.5 + 0.5 * seen.cosine), 2.5e-6, 15e-6);
      add_pass({s, plane, i, sync_s, *time_s + common_s + own_s, length_s, slow_bit}, false);
    }
  }
}

// The time at which the plane meets the moving sensor: turned(t) = angle of p(t). The sensor moves slowly beside the
// plane, so that each step gains two digits.
std::optional<double> Lh2Simulator::hit_time(std::size_t s, std::size_t plane, std::size_t sensor,
                                             double sync_s) const {
  const double period_s = turning_[s].period_s;
  double time_s = sync_s + period_s * (plane == 0 ? 1.0 : 2.0) / 3;
  for (int step = 0; step < kHitSearchSteps; ++step) {
    const Vector3 p =
        stations_[s].pose.inverse() * (scenario_.trajectory->at(time_s) * true_target_[sensor].position_m);
    if (p.z() <= 0.05 * p.norm() || std::abs(p.y()) > 1.2 * std::hypot(p.x(), p.z())) return std::nullopt;
    const double next_s = sync_s + period_s * turned_angle(plane, stations_[s].actual[plane], p) / kTwoPi;
    const double change_s = next_s - time_s;
    time_s = next_s;
    if (std::abs(change_s) < kHitSearchEnd_s) return time_s;
  }
  return std::nullopt;
}

void Lh2Simulator::add_pass(Light light, bool reflection) {
  const FaultScenario& faults = scenario_.faults;
  const int sensor = true_target_[light.sensor].sensor;
  const int station = static_cast<int>(light.station);
  if (fault_random_.chance(faults.missed_hit_rate)) return note(light.middle_s, "missed_hit", station, sensor, 0.0);
  const double turned_rad = kTwoPi * (light.middle_s - light.sync_s) / turning_[light.station].period_s;
  passes_.push_back({clock_.counter_time(light.middle_s), clock_.counter_time(light.sync_s), turned_rad, station,
                     static_cast<int>(light.plane), sensor, light.slow_bit, reflection});
  if (!reflection) {
    for (const ReflectionScenario& r : faults.reflections) {
      const bool here = r.station == station && static_cast<std::size_t>(r.rotor) == light.plane &&
                        light.middle_s >= r.from_s && light.middle_s < r.to_s &&
                        std::find(r.sensors.begin(), r.sensors.end(), sensor) != r.sensors.end();
      if (!here) continue;
      Light second = light;
      second.middle_s += seconds(r.delay_ticks);
      second.length_s *= r.width_ratio;
      note(second.middle_s, "reflection", station, sensor, r.delay_ticks);
      add_pass(second, true);
    }
  }
  if (fault_random_.chance(faults.cut_burst_rate)) {
    // Only a part of the light reaches the receiver, from one of its ends.
    const double kept = fault_random_.uniform(0.3, 0.9);
    const double side = fault_random_.chance(0.5) ? 1.0 : -1.0;
    light.middle_s += side * 0.5 * (1.0 - kept) * light.length_s;
    light.length_s *= kept;
    note(light.middle_s, "cut_burst", station, sensor, kept);
  }
  add_light(light);
}

void Lh2Simulator::add_light(const Light& light) {
  const double begin_s = light.middle_s - 0.5 * light.length_s, end_s = light.middle_s + 0.5 * light.length_s;
  add_event(begin_s, light.sensor, +1);
  add_event(end_s, light.sensor, -1);
  const double bit_s = 1.0 / (kBitRate_Hz * stations_[light.station].rate);
  const std::vector<bool>& code = turning_[light.station].code[light.slow_bit ? 1 : 0];
  const double from = (begin_s - kDataBefore_s - light.sync_s) / bit_s,
               to = (end_s + kDataAfter_s - light.sync_s) / bit_s;
  for (const double change : level_changes(code, from, to)) {
    const double exact_s = light.sync_s + change * bit_s;
    const bool at_ends = exact_s < begin_s || exact_s > end_s;
    const double jitter_s = scenario_.noise.bit_jitter_ns * 1e-9 * noise_.normal();
    if (fault_random_.chance(at_ends ? kLostAtEnds : scenario_.faults.lost_edge_rate)) continue;
    add_event(exact_s + (at_ends ? 2.0 : 1.0) * jitter_s, light.sensor, 0);
  }
}

void Lh2Simulator::add_noise(double from_s, double to_s) {
  if (to_s <= from_s) return;
  const int count = fault_random_.poisson(scenario_.faults.glitches_per_s * (to_s - from_s));
  for (int i = 0; i < count; ++i) {
    const double at_s = fault_random_.uniform(from_s, to_s);
    const auto sensor = static_cast<std::size_t>(fault_random_.below(static_cast<int>(true_target_.size())));
    add_event(at_s, sensor, 0);
    add_event(at_s + kNoisePulse_s, sensor, 0);
  }
}

bool Lh2Simulator::blocked(std::size_t sensor, double time_s) {
  for (const Interval& blackout : scenario_.faults.blackouts) {
    if (time_s >= blackout.from_s && time_s < blackout.to_s) return true;
  }
  for (const auto& [interval, covered] : hands_) {
    if (covered[sensor] && time_s >= interval.from_s && time_s < interval.to_s) return true;
  }
  return !scenario_.trajectory->lit(time_s);
}

void Lh2Simulator::add_event(double time_s, std::size_t sensor, int light) {
  events_.push({time_s, number_++, sensor, light});
}

// Light of two stations at one receiver: its level changes with either's, as far as the changes are not too close.
std::optional<LightChange> Lh2Simulator::take(const Event& event) {
  Receiver& receiver = receivers_[event.sensor];
  const bool dark_before = receiver.lights == 0;
  receiver.lights += event.light;
  if (event.light == 0) {
    if (event.time_s - receiver.changed_s < kShortestLevel_s) return std::nullopt;
    receiver.changed_s = event.time_s;
    receiver.data = !receiver.data;
  } else if (dark_before == (receiver.lights == 0)) {
    return std::nullopt;
  }
  receiver.last_ticks = std::max(receiver.last_ticks, clock_.stamp(event.time_s));
  return LightChange{receiver.last_ticks, true_target_[event.sensor].sensor, receiver.data, receiver.lights == 0};
}

void Lh2Simulator::note(double time_s, const char* kind, int station, int sensor, double amount) {
  faults_.push_back({clock_.counter_time(time_s), kind, station, sensor, amount});
}

}  // namespace pharos::sim
