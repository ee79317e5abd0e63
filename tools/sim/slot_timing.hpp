// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "tools/sim/random_stream.hpp"
#include "tools/sim/scenario.hpp"

namespace pharos::sim {

/// One turn of one rotor of one station in one slot.
struct StationSlot {
  bool on = false;       // the station flashes in this slot
  bool skip = false;     // its laser is dark
  double flash_s = 0.0;  // true time of the flash, all jitter in it
  double zero_s = 0.0;   // true time at which the laser sheet's turn is 0
  double period_s = 0.0;
};

/// One slot of the stations' cycle: 8.33 ms that belong to one axis.
struct Slot {
  Rotor rotor = Rotor::kX;
  double start_s = 0.0;  // undisturbed time of the first station's flash
  std::array<StationSlot, 2> station;
};

/// Times of the stations' flashes and rotors, slot after slot in the order of time.
///
/// The rotors of a station wander slowly and independently; the jitter of a turn shifts flash and laser together; flash
/// jitter shifts only the flash and thereby every angle measured from it. Cycle of a pair: the other station sweeps in
/// slots 0 (X) and 1 (Y), the first in 2 and 3; a single station in mode A sweeps in every slot.
class SlotTiming {
 public:
  SlotTiming(const LighthouseScenario& scenario, std::uint64_t seed);

  /// The next slot; it may begin after the scenario's end.
  Slot next();

 private:
  // A sum of sines with periods of 3 to 30 s: the residual error of a rotor's control loop.
  struct Wander {
    std::array<Sine, 3> sines;
    double at(double time_s) const;
  };
  static Wander draw_wander(RandomStream& random, double deviation_ticks);
  void restart_if_due();
  bool is_off(std::size_t station, double time_s) const;
  double undisturbed_s(std::int64_t slot) const { return origin_s_ + static_cast<double>(slot) * 0.5 * period_s_; }
  double rotor_time_s(std::size_t station, Rotor rotor, double undisturbed_s) const;

  const LighthouseScenario& scenario_;
  RandomStream random_;
  double period_s_;
  double turn_jitter_s_;
  double flash_jitter_s_;
  double origin_s_ = 0.0;
  std::int64_t slot_ = 0;
  int cycle_offset_ = 0;
  std::array<std::array<Wander, 2>, 2> wander_;
  std::vector<RestartScenario> restarts_;  // of the first station, still to come
};

}  // namespace pharos::sim
