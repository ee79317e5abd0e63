// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/lighthouse_simulator.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/base/units.hpp"
#include "tools/sim/ticks.hpp"

namespace pharos::sim {
namespace {

// Longest look-back from a slot's start to a pulse of that slot: jitter, wander and reflections before the hit.
constexpr std::int64_t kSlotMargin_ticks = 2000;
constexpr double kHitSearchEnd_rad = 1e-11;
constexpr int kHitSearchSteps = 12;

}  // namespace

LighthouseSimulator::LighthouseSimulator(LighthouseScenario scenario, std::uint64_t seed)
    : scenario_(std::move(scenario)),
      clock_(scenario_.clock.start_ticks, scenario_.clock.offset_ppm, scenario_.clock.drift_ppm_per_s),
      timing_(scenario_, seed),
      hit_noise_(seed, "hit noise"),
      flash_noise_(seed, "flash noise"),
      fault_random_(seed, "faults"),
      order_random_(seed, "order"),
      open_rise_(kMaxSensors) {
  draw_stations(seed);
  draw_true_target(seed);
  draw_hands();
  queue_stale_pulses();
  for (const Interval& blackout : scenario_.faults.blackouts) {
    note(blackout.from_s, "blackout", -1, -1, blackout.to_s - blackout.from_s);
  }
  for (const RestartScenario& restart : scenario_.faults.restarts) {
    note(restart.at_s, "station_restart", restart.station, -1, restart.off_s);
  }
}

void LighthouseSimulator::draw_stations(std::uint64_t seed) {
  RandomStream typical(seed, "typical calibration");
  RandomStream residual(seed, "calibration residuals");
  RandomStream start_bit(seed, "ootx start");
  const ErrorScenario& errors = scenario_.errors;
  for (const StationScenario& given : scenario_.stations) {
    SimulatedStation station;
    station.pose = given.pose;
    station.announced.id = given.id;
    station.announced.mode = static_cast<std::uint8_t>(given.mode);
    for (std::size_t rotor = 0; rotor < 2; ++rotor) {
      // Ranges of the calibrations of eight real stations.
      const SheetErrors drawn{typical.uniform(0.015, 0.062), typical.uniform(-0.0096, 0.0096),
                              typical.uniform(-0.0083, 0.0083), typical.uniform(-2.0, 2.0),
                              typical.uniform(-0.0206, 0.0206)};
      SheetErrors& announced = station.announced.rotor[rotor];
      announced = as_transmitted(given.calibration ? (*given.calibration)[rotor] : drawn);
      SheetErrors& actual = station.true_errors[rotor];
      actual = announced;
      actual.phase_rad += errors.phase_rad * residual.normal();
      actual.tilt_rad += errors.tilt_rad * residual.normal();
      actual.curve_rad += errors.curve_rad * residual.normal();
      actual.gibbous_magnitude_rad += errors.gibbous_magnitude_rad * residual.normal();
    }
    sheets_.push_back({LaserSheet(Rotor::kX, scenario_.form, station.true_errors[0]),
                       LaserSheet(Rotor::kY, scenario_.form, station.true_errors[1])});
    Sender sender;
    sender.frame = ootx_frame_bits(announcement_bytes(station.announced));
    sender.bit = static_cast<std::size_t>(start_bit.below(static_cast<int>(sender.frame.size())));
    sender.flipped = sender.frame.size();
    senders_.push_back(std::move(sender));
    stations_.push_back(station);
  }
}

void LighthouseSimulator::draw_true_target(std::uint64_t seed) {
  RandomStream position(seed, "sensor positions");
  RandomStream lateness(seed, "lateness");
  true_target_ = scenario_.target;
  for (SensorPlacement& sensor : true_target_) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      sensor.position_m[axis] += scenario_.errors.sensor_position_m * position.normal();
    }
    lateness_.push_back(lateness.uniform(scenario_.light.lateness_low, scenario_.light.lateness_high));
  }
}

std::optional<SimulatedPulse> LighthouseSimulator::next() {
  if (doubled_) {
    const SimulatedPulse pulse = *doubled_;
    doubled_.reset();
    return pulse;
  }
  while (true) {
    while (!ended_ && (queue_.empty() || queue_.top().order_ticks >= complete_until_ticks_)) simulate_slot();
    if (queue_.empty()) return std::nullopt;
    const SimulatedPulse pulse = queue_.top().pulse;
    queue_.pop();
    if (const std::optional<SimulatedPulse> kept = with_edge_faults(pulse)) return kept;
  }
}

LighthouseFromBody LighthouseSimulator::pose(std::size_t station, double time_s) const {
  return stations_[station].pose.inverse() * scenario_.trajectory->at(time_s);
}

LighthouseFromBody LighthouseSimulator::truth(std::size_t station, double counter_s) const {
  return pose(station, clock_.true_time(counter_s));
}

bool LighthouseSimulator::dark(double time_s) const {
  for (const Interval& blackout : scenario_.faults.blackouts) {
    if (time_s >= blackout.from_s && time_s < blackout.to_s) return true;
  }
  return !scenario_.trajectory->lit(time_s);
}

void LighthouseSimulator::simulate_slot() {
  const Slot slot = timing_.next();
  complete_until_ticks_ = clock_.stamp(slot.start_s) - kSlotMargin_ticks;
  if (slot.start_s >= scenario_.duration_s) {
    ended_ = true;
    return;
  }
  queue_flashes(slot);
  for (std::size_t station = 0; station < stations_.size(); ++station) queue_hits(station, slot);
  queue_noise_pulses(slot);
}

bool LighthouseSimulator::next_bit(std::size_t station, double time_s) {
  Sender& sender = senders_[station];
  if (sender.bit == sender.frame.size()) {
    sender.bit = 0;
    sender.flipped = sender.frame.size();
    if (fault_random_.chance(scenario_.faults.ootx_corrupt_rate)) {
      // Behind the preamble (18 bits) and the length word (17 bits), never a bit that is always one.
      do {
        sender.flipped = 35 + static_cast<std::size_t>(fault_random_.below(static_cast<int>(sender.frame.size()) - 35));
      } while ((sender.flipped - 18) % 17 == 16);
      note(time_s, "ootx_corrupt", static_cast<int>(station), -1, static_cast<double>(sender.flipped));
    }
  }
  const bool bit = sender.frame[sender.bit] != (sender.bit == sender.flipped);
  ++sender.bit;
  return bit;
}

std::vector<LighthouseSimulator::FlashPulse> LighthouseSimulator::flash(std::size_t station, const Slot& slot) {
  const StationSlot& timing = slot.station[station];
  std::vector<FlashPulse> pulses(true_target_.size());
  const bool bit = next_bit(station, timing.flash_s);
  if (dark(timing.flash_s)) return pulses;
  const FaultScenario& faults = scenario_.faults;
  if (misses_flash(station)) {
    note(timing.flash_s, "missed_flash", static_cast<int>(station), -1);
    return pulses;
  }
  double stretch_ticks = 0.0;
  if (fault_random_.chance(faults.stretched_flash_rate)) {
    stretch_ticks = fault_random_.uniform(100.0, 1500.0);
    note(timing.flash_s, "stretched_flash", static_cast<int>(station), -1, stretch_ticks);
  }
  const double nominal = nominal_flash_ticks(slot.rotor, bit, timing.skip);
  const LighthouseFromBody T_L_B = pose(station, timing.flash_s);
  std::vector<double> lengths(true_target_.size(), 0.0);
  double longest = 0.0;
  for (std::size_t i = 0; i < true_target_.size(); ++i) {
    const Illumination seen = illuminate(T_L_B, true_target_[i], scenario_.light, scenario_.body);
    if (!seen.lit) continue;
    pulses[i].seen = true;
    lengths[i] = nominal + flash_excess_ticks(seen, scenario_.light);
    longest = std::max(longest, lengths[i]);
  }
  for (std::size_t i = 0; i < true_target_.size(); ++i) {
    if (!pulses[i].seen) continue;
    if (fault_random_.chance(faults.missed_flash_pulse_rate)) {
      pulses[i].seen = false;
      note(timing.flash_s, "missed_flash_pulse", static_cast<int>(station), true_target_[i].sensor);
      continue;
    }
    const double late =
        lateness_[i] * (longest - lengths[i]) + scenario_.noise.flash_rise_ticks * flash_noise_.normal();
    const double length = lengths[i] + stretch_ticks + scenario_.noise.width_ticks * flash_noise_.normal();
    pulses[i].rise_s = timing.flash_s + seconds(late);
    pulses[i].fall_s = pulses[i].rise_s + seconds(length);
  }
  return pulses;
}

void LighthouseSimulator::queue_flashes(const Slot& slot) {
  std::vector<std::vector<FlashPulse>> flashes;
  for (std::size_t station = 0; station < stations_.size(); ++station) {
    flashes.push_back(slot.station[station].on ? flash(station, slot) : std::vector<FlashPulse>(true_target_.size()));
  }
  const bool merged = flashes.size() == 2 && fault_random_.chance(scenario_.faults.merged_flash_rate);
  if (merged) note(slot.start_s, "merged_flash", -1, -1);
  for (std::size_t i = 0; i < true_target_.size(); ++i) {
    if (merged && flashes[0][i].seen && flashes[1][i].seen) {
      queue(i, flashes[0][i].rise_s, flashes[1][i].fall_s);
      continue;
    }
    for (const std::vector<FlashPulse>& pulses : flashes) {
      if (pulses[i].seen) queue(i, pulses[i].rise_s, pulses[i].fall_s);
    }
  }
}

// The time at which the sheet meets the moving sensor: lead(turn(t), p(t)) = 0. The lead decreases at the rotor's rate,
// except for the sensor's own motion (at most one per cent), so that each step of lead / rate gains two digits.
std::optional<double> LighthouseSimulator::hit_time(std::size_t station, const Slot& slot, std::size_t sensor) const {
  const StationSlot& timing = slot.station[station];
  const LaserSheet& sheet = sheets_[station][static_cast<std::size_t>(slot.rotor)];
  const double rate = kTwoPi / timing.period_s;
  const Vector3& p_body = true_target_[sensor].position_m;
  Vector3 p = pose(station, timing.zero_s + 0.25 * timing.period_s) * p_body;
  if (p.z() <= 0.0) return std::nullopt;
  double time_s = timing.zero_s + sheet.ideal_turn(p) / rate;
  for (int step = 0; step < kHitSearchSteps; ++step) {
    p = pose(station, time_s) * p_body;
    if (p.z() <= 0.0) return std::nullopt;
    const double lead = sheet.lead(rate * (time_s - timing.zero_s), p);
    time_s += lead / rate;
    if (std::abs(lead) < kHitSearchEnd_rad) return time_s;
  }
  return std::nullopt;
}

void LighthouseSimulator::queue_hits(std::size_t station, const Slot& slot) {
  const StationSlot& timing = slot.station[station];
  if (!timing.on || timing.skip) return;
  const NoiseScenario& noise = scenario_.noise;
  const double sigma_s = noise.sigma_arcsec * kRadPerArcsec * timing.period_s / kTwoPi;
  const double common_s = sigma_s * std::sqrt(noise.rho * (1.0 - noise.flash_fraction)) * hit_noise_.normal();
  const double own_s = sigma_s * std::sqrt(1.0 - noise.rho);
  const double narrow_s = noise.narrow_sigma_arcsec * kRadPerArcsec * timing.period_s / kTwoPi;
  for (std::size_t i = 0; i < true_target_.size(); ++i) {
    const double draw = hit_noise_.normal();
    const double narrow_draw = hit_noise_.normal();
    const std::optional<double> time_s = hit_time(station, slot, i);
    if (!time_s || dark(*time_s)) continue;
    const Illumination seen = illuminate(pose(station, *time_s), true_target_[i], scenario_.light, scenario_.body);
    if (!seen.lit) continue;
    const double width = hit_width_ticks(seen, scenario_.light);
    const double narrowness = std::clamp((104.0 - width) / 52.0, 0.0, 1.0);
    queue_hit(station, slot, i, *time_s + common_s + own_s * draw + narrow_s * narrowness * narrow_draw, width);
  }
}

void LighthouseSimulator::queue_hit(std::size_t station, const Slot& slot, std::size_t sensor, double centre_s,
                                    double width_ticks) {
  const FaultScenario& faults = scenario_.faults;
  const double width = std::max(width_ticks + scenario_.noise.width_ticks * hit_noise_.normal(), 5.0);
  if (fault_random_.chance(faults.missed_hit_rate)) {
    note(centre_s, "missed_hit", static_cast<int>(station), true_target_[sensor].sensor);
    return;
  }
  if (covered(sensor, centre_s)) {
    // Light through or around fingers: half of the hits vanish, half become as long as a flash.
    if (fault_random_.chance(0.5)) return;
    const double smeared = fault_random_.uniform(3000.0, 7000.0);
    queue(sensor, centre_s - seconds(0.5 * smeared), centre_s + seconds(0.5 * smeared));
    return;
  }
  queue(sensor, centre_s - seconds(0.5 * width), centre_s + seconds(0.5 * width));
  if (!faults.reflections.empty()) queue_reflections(station, slot, sensor, centre_s, width);
}

void LighthouseSimulator::queue(std::size_t sensor, double rise_s, double fall_s) {
  QueuedPulse queued;
  queued.pulse = {clock_.stamp(rise_s), clock_.stamp(fall_s), true_target_[sensor].sensor};
  queued.order_ticks = queued.pulse.fall_ticks;
  if (order_random_.chance(scenario_.faults.reorder_rate)) {
    const double delay_us = order_random_.uniform(0.0, scenario_.faults.reorder_us);
    queued.order_ticks += std::llround(delay_us * 1e-6 / kTick_s);
  }
  queued.number = queued_++;
  queue_.push(queued);
}

}  // namespace pharos::sim
