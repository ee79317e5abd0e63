// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/slot_timing.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/base/units.hpp"
#include "tools/sim/ticks.hpp"

namespace pharos::sim {
namespace {

constexpr std::size_t index(Rotor rotor) { return static_cast<std::size_t>(rotor); }

}  // namespace

double SlotTiming::Wander::at(double time_s) const {
  return sines[0].at(time_s) + sines[1].at(time_s) + sines[2].at(time_s);
}

SlotTiming::Wander SlotTiming::draw_wander(RandomStream& random, double deviation_ticks) {
  Wander wander;
  // Three sines of equal amplitude a have the variance 3 a^2 / 2.
  const double amplitude = deviation_ticks * kTick_s * std::sqrt(2.0 / 3.0);
  for (Sine& sine : wander.sines) {
    sine = {amplitude, 1.0 / random.uniform(3.0, 30.0), random.uniform(0.0, kTwoPi)};
  }
  return wander;
}

SlotTiming::SlotTiming(const LighthouseScenario& scenario, std::uint64_t seed)
    : scenario_(scenario),
      random_(seed, "slot timing"),
      period_s_(1.0 / (scenario.rotor.rate_hz * (1.0 + scenario.rotor.offset_ppm * 1e-6))),
      turn_jitter_s_(scenario.rotor.turn_jitter_ticks * kTick_s) {
  const double sigma = scenario.noise.sigma_arcsec * kRadPerArcsec;
  flash_jitter_s_ =
      sigma * std::sqrt(std::max(scenario.noise.rho, 0.0) * scenario.noise.flash_fraction) * period_s_ / kTwoPi;
  for (std::size_t station = 0; station < 2; ++station) {
    for (std::size_t rotor = 0; rotor < 2; ++rotor) {
      wander_[station][rotor] =
          draw_wander(random_, station == 0 ? scenario.rotor.wander_ticks : scenario.rotor.second_wander_ticks);
    }
  }
  origin_s_ = random_.uniform(0.0, period_s_);
  cycle_offset_ = random_.below(4);
  for (const RestartScenario& restart : scenario.faults.restarts) {
    if (restart.station == 0) restarts_.push_back(restart);
  }
  std::sort(restarts_.begin(), restarts_.end(),
            [](const RestartScenario& a, const RestartScenario& b) { return a.at_s < b.at_s; });
}

bool SlotTiming::is_off(std::size_t station, double time_s) const {
  for (const RestartScenario& restart : scenario_.faults.restarts) {
    if (static_cast<std::size_t>(restart.station) == station && time_s >= restart.at_s &&
        time_s < restart.at_s + restart.off_s) {
      return true;
    }
  }
  return false;
}

// The first station determines the cycle: when it restarts, the cycle begins again at another phase.
void SlotTiming::restart_if_due() {
  while (!restarts_.empty() && undisturbed_s(slot_) >= restarts_.front().at_s) {
    const double back_s = restarts_.front().at_s + restarts_.front().off_s;
    restarts_.erase(restarts_.begin());
    if (back_s < undisturbed_s(slot_)) continue;
    origin_s_ = back_s + random_.uniform(0.0, period_s_);
    slot_ = 0;
    cycle_offset_ = random_.below(4);
    for (Wander& wander : wander_[0]) wander = draw_wander(random_, scenario_.rotor.wander_ticks);
  }
}

// True time of the rotor's zero without jitter from turn to turn. A second station follows the first one's flash.
double SlotTiming::rotor_time_s(std::size_t station, Rotor rotor, double undisturbed_s) const {
  double time_s = undisturbed_s + wander_[0][index(rotor)].at(undisturbed_s);
  if (station == 1) {
    time_s += scenario_.rotor.second_delay_ticks * kTick_s + wander_[1][index(rotor)].at(undisturbed_s);
  }
  return time_s;
}

Slot SlotTiming::next() {
  restart_if_due();
  const auto phase = static_cast<int>((slot_ + cycle_offset_) % 4);
  Slot slot;
  slot.rotor = phase % 2 == 0 ? Rotor::kX : Rotor::kY;
  slot.start_s = undisturbed_s(slot_);
  const bool pair = scenario_.stations.size() == 2;
  for (std::size_t i = 0; i < scenario_.stations.size(); ++i) {
    StationSlot& station = slot.station[i];
    const double zero_s = rotor_time_s(i, slot.rotor, slot.start_s);
    const double jitter_s = turn_jitter_s_ * random_.normal();
    station.zero_s = zero_s + jitter_s;
    station.period_s = rotor_time_s(i, slot.rotor, slot.start_s + period_s_) - zero_s;
    station.flash_s = station.zero_s + flash_jitter_s_ * random_.normal();
    station.on = !is_off(i, slot.start_s);
    // A single master or slave keeps the dark slots of the missing station.
    const bool second = i == 1 || (!pair && scenario_.stations[i].mode == StationMode::kC);
    const bool alone = !pair && scenario_.stations[i].mode == StationMode::kA;
    station.skip = !alone && (phase >= 2) == second;
  }
  ++slot_;
  return slot;
}

}  // namespace pharos::sim
