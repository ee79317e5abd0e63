// SPDX-License-Identifier: Apache-2.0
// The faults that LighthouseSimulator injects on request: all that occur in recordings.
#include <algorithm>
#include <cmath>

#include "tools/sim/lighthouse_simulator.hpp"
#include "tools/sim/ticks.hpp"

namespace pharos::sim {
namespace {

constexpr std::int64_t kSaturated_ticks = 68266;  // 65,535 ticks at 48 MHz, as devices send it

}  // namespace

void LighthouseSimulator::draw_hands() {
  const FaultScenario& faults = scenario_.faults;
  const int count = fault_random_.poisson(faults.hands_per_s * scenario_.duration_s);
  for (int i = 0; i < count; ++i) {
    const double from_s = fault_random_.uniform(0.0, scenario_.duration_s);
    Hand hand{{from_s, from_s + faults.hand_s}, {}};
    for (const SensorPlacement& sensor : true_target_) {
      hand.covered.push_back(fault_random_.chance(faults.hand_fraction));
      if (hand.covered.back()) note(from_s, "hand", -1, sensor.sensor, faults.hand_s);
    }
    hands_.push_back(std::move(hand));
  }
}

// Old pulses from a device's buffer: saturated, and at times far from those of the others.
void LighthouseSimulator::queue_stale_pulses() {
  const std::int64_t first = clock_.stamp(0.0);
  for (int i = 0; i < scenario_.faults.stale_pulses; ++i) {
    const auto sensor = static_cast<std::size_t>(fault_random_.below(static_cast<int>(true_target_.size())));
    const std::int64_t rise = first + std::llround(scenario_.faults.stale_s / kTick_s) + fault_random_.below(200'000);
    QueuedPulse stale;
    stale.order_ticks = first - scenario_.faults.stale_pulses + i;
    stale.number = queued_++;
    stale.pulse = {rise, rise + kSaturated_ticks, true_target_[sensor].sensor};
    queue_.push(stale);
    note(0.0, "stale", -1, stale.pulse.sensor, scenario_.faults.stale_s);
  }
}

bool LighthouseSimulator::covered(std::size_t sensor, double time_s) const {
  return std::any_of(hands_.begin(), hands_.end(), [&](const Hand& hand) {
    return hand.covered[sensor] && time_s >= hand.interval.from_s && time_s < hand.interval.to_s;
  });
}

void LighthouseSimulator::note(double time_s, const char* kind, int station, int sensor, double amount) {
  faults_.push_back({clock_.counter_time(time_s), kind, station, sensor, amount});
}

// Runs of missed flashes with a geometric distribution of lengths; they begin at the rate that gives the given
// fraction.
bool LighthouseSimulator::misses_flash(std::size_t station) {
  const FaultScenario& faults = scenario_.faults;
  if (faults.missed_flash_rate <= 0.0) return false;
  bool& missing = senders_[station].missing;
  const double end = 1.0 / faults.missed_flash_burst;
  const double begin = faults.missed_flash_rate >= 1.0
                           ? 1.0
                           : std::min(faults.missed_flash_rate * end / (1.0 - faults.missed_flash_rate), 1.0);
  missing = missing ? !fault_random_.chance(end) || fault_random_.chance(begin) : fault_random_.chance(begin);
  return missing;
}

void LighthouseSimulator::queue_reflections(std::size_t station, const Slot& slot, std::size_t sensor, double centre_s,
                                            double width_ticks) {
  for (const ReflectionScenario& reflection : scenario_.faults.reflections) {
    const int number = true_target_[sensor].sensor;
    if (static_cast<std::size_t>(reflection.station) != station || reflection.rotor != slot.rotor ||
        centre_s < reflection.from_s || centre_s >= reflection.to_s ||
        std::find(reflection.sensors.begin(), reflection.sensors.end(), number) == reflection.sensors.end()) {
      continue;
    }
    const double second_s = centre_s + seconds(reflection.delay_ticks);
    const double half_s = seconds(0.5 * reflection.width_ratio * width_ticks);
    queue(sensor, second_s - half_s, second_s + half_s);
    note(second_s, "reflection", static_cast<int>(station), number, reflection.delay_ticks);
  }
}

void LighthouseSimulator::queue_noise_pulses(const Slot& slot) {
  const double slot_s = 0.5 / scenario_.rotor.rate_hz;
  const auto scatter = [&](double per_s, const char* kind, double low_ticks, double high_ticks) {
    if (per_s <= 0.0) return;
    for (int left = fault_random_.poisson(per_s * slot_s); left > 0; --left) {
      const auto sensor = static_cast<std::size_t>(fault_random_.below(static_cast<int>(true_target_.size())));
      const double rise_s = slot.start_s + fault_random_.uniform(0.0, slot_s);
      const double ticks = fault_random_.uniform(low_ticks, high_ticks);
      queue(sensor, rise_s, rise_s + seconds(ticks));
      note(rise_s, kind, -1, true_target_[sensor].sensor, ticks);
    }
  };
  scatter(scenario_.faults.glitches_per_s, "glitch", 1.0, 20.0);
  scatter(scenario_.faults.endless_per_s, "endless", 1e6, 1e7);
}

// Edges lost or doubled between photodiode and stamp, as recorded by a device that pairs a rise with the next fall.
std::optional<SimulatedPulse> LighthouseSimulator::with_edge_faults(SimulatedPulse pulse) {
  const FaultScenario& faults = scenario_.faults;
  if (faults.lost_edge_rate == 0.0 && faults.doubled_rate == 0.0) return pulse;
  const double true_s = clock_.true_time(static_cast<double>(pulse.rise_ticks) * kTick_s);
  std::optional<std::int64_t>& open = open_rise_[pulse.sensor];
  if (order_random_.chance(faults.lost_edge_rate)) {
    note(true_s, "lost_rise", -1, pulse.sensor);
    return std::nullopt;
  }
  if (order_random_.chance(faults.lost_edge_rate)) {
    note(true_s, "lost_fall", -1, pulse.sensor);
    if (!open) open = pulse.rise_ticks;
    return std::nullopt;
  }
  if (open) {
    pulse.rise_ticks = *open;
    open.reset();
  }
  if (order_random_.chance(faults.doubled_rate)) {
    note(true_s, "doubled", -1, pulse.sensor);
    doubled_ = pulse;
  }
  return pulse;
}

}  // namespace pharos::sim
