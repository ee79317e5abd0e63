// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <queue>
#include <string>
#include <vector>

#include "tools/sim/light.hpp"
#include "tools/sim/ootx_sender.hpp"
#include "tools/sim/random_stream.hpp"
#include "tools/sim/scenario.hpp"
#include "tools/sim/slot_timing.hpp"
#include "tools/sim/target_clock.hpp"

namespace pharos::sim {

/// One light pulse on one sensor as the target stamps it: 20 ns ticks, unwrapped, start of the counter included.
struct SimulatedPulse {
  std::int64_t rise_ticks = 0;
  std::int64_t fall_ticks = 0;
  std::uint8_t sensor = 0;
};

/// One fault that was injected.
struct InjectedFault {
  double time_s = 0.0;  // counter time
  const char* kind = "";
  int station = -1;     // -1: not of one station
  int sensor = -1;      // -1: not of one sensor
  double amount = 0.0;  // of the kind's own unit, see README
};

/// A station's true and announced errors.
struct SimulatedStation {
  RoomFromStation pose;
  StationAnnouncement announced;           // rotor values as half precision keeps them
  std::array<SheetErrors, 2> true_errors;  // announced plus the systematic errors
};

/// Lighthouse 1.0 stations and a target in front of them: pulses with the stamps of the target's counter, in the order
/// of their ends (as in recordings) except for injected reordering. The same scenario and seed give the same pulses.
///
/// Every hit is at the time at which the laser sheet meets the moving sensor. About 300 times real time for 12 sensors.
/// Counter time is unwrapped ticks x 20 ns throughout.
class LighthouseSimulator {
 public:
  LighthouseSimulator(LighthouseScenario scenario, std::uint64_t seed);
  LighthouseSimulator(const LighthouseSimulator&) = delete;
  LighthouseSimulator& operator=(const LighthouseSimulator&) = delete;

  /// The next pulse; empty at the scenario's end.
  std::optional<SimulatedPulse> next();

  /// T_lighthouse_body of a station at a counter time.
  LighthouseFromBody truth(std::size_t station, double counter_s) const;
  /// Counter time of the scenario's start and end.
  double start_s() const { return clock_.counter_time(0.0); }
  double end_s() const { return clock_.counter_time(scenario_.duration_s); }

  const LighthouseScenario& scenario() const { return scenario_; }
  const TargetClock& clock() const { return clock_; }
  const std::vector<SimulatedStation>& stations() const { return stations_; }
  const Target& nominal_target() const { return scenario_.target; }
  const Target& true_target() const { return true_target_; }
  /// The faults injected so far, not strictly in the order of time.
  const std::vector<InjectedFault>& faults() const { return faults_; }

 private:
  struct QueuedPulse {
    std::int64_t order_ticks = 0;  // when it is given out
    std::uint64_t number = 0;      // keeps equal times in order
    SimulatedPulse pulse;
    bool operator>(const QueuedPulse& other) const {
      return order_ticks != other.order_ticks ? order_ticks > other.order_ticks : number > other.number;
    }
  };
  // One sensor's share of one flash.
  struct FlashPulse {
    bool seen = false;
    double rise_s = 0.0;
    double fall_s = 0.0;
  };
  struct Sender {
    std::vector<bool> frame;
    std::size_t bit = 0;
    std::size_t flipped = 0;  // position of the wrong bit, beyond the frame if none
    bool missing = false;     // its flashes are not seen at present
  };
  struct Hand {
    Interval interval;
    std::vector<bool> covered;
  };

  void draw_stations(std::uint64_t seed);
  void draw_true_target(std::uint64_t seed);
  void draw_hands();
  void queue_stale_pulses();
  void simulate_slot();
  bool next_bit(std::size_t station, double time_s);
  bool misses_flash(std::size_t station);
  std::vector<FlashPulse> flash(std::size_t station, const Slot& slot);
  void queue_flashes(const Slot& slot);
  void queue_hits(std::size_t station, const Slot& slot);
  std::optional<double> hit_time(std::size_t station, const Slot& slot, std::size_t sensor) const;
  void queue_hit(std::size_t station, const Slot& slot, std::size_t sensor, double centre_s, double width_ticks);
  void queue_reflections(std::size_t station, const Slot& slot, std::size_t sensor, double centre_s,
                         double width_ticks);
  void queue_noise_pulses(const Slot& slot);
  void queue(std::size_t sensor, double rise_s, double fall_s);
  LighthouseFromBody pose(std::size_t station, double time_s) const;
  bool dark(double time_s) const;
  bool covered(std::size_t sensor, double time_s) const;
  std::optional<SimulatedPulse> with_edge_faults(SimulatedPulse pulse);
  void note(double time_s, const char* kind, int station, int sensor, double amount = 0.0);

  LighthouseScenario scenario_;
  TargetClock clock_;
  SlotTiming timing_;
  RandomStream hit_noise_;
  RandomStream flash_noise_;
  RandomStream fault_random_;
  RandomStream order_random_;
  std::vector<SimulatedStation> stations_;
  std::vector<std::array<LaserSheet, 2>> sheets_;
  std::vector<Sender> senders_;
  Target true_target_;
  std::vector<double> lateness_;
  std::vector<Hand> hands_;
  std::vector<InjectedFault> faults_;

  std::priority_queue<QueuedPulse, std::vector<QueuedPulse>, std::greater<>> queue_;
  std::uint64_t queued_ = 0;
  std::int64_t complete_until_ticks_ = 0;  // no pulse before this order is still to be made
  bool ended_ = false;
  std::vector<std::optional<std::int64_t>> open_rise_;  // of a sensor whose falling edge was lost
  std::optional<SimulatedPulse> doubled_;
};

}  // namespace pharos::sim
