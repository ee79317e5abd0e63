// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <queue>
#include <vector>

#include "tools/sim/laser_plane.hpp"
#include "tools/sim/lh2/light_code.hpp"
#include "tools/sim/lighthouse_simulator.hpp"
#include "tools/sim/random_stream.hpp"
#include "tools/sim/scenario.hpp"
#include "tools/sim/target_clock.hpp"

namespace pharos::sim {

/// A receiver's outputs after a change: 20 ns ticks, unwrapped.
struct LightChange {
  std::int64_t time_ticks = 0;
  std::uint8_t sensor = 0;
  bool data = false;
  bool envelope = true;  // as a receiver gives it: false while there is light
};

/// Light of one laser plane at one sensor, as it was: truth.
struct LightPass {
  double time_s = 0.0;  // counter time of its middle
  double sync_s = 0.0;  // counter time of the turn's sync
  double turned_rad = 0.0;
  int station = 0;
  int plane = 0;
  int sensor = 0;
  bool slow_bit = false;
  bool reflection = false;
};

/// A Lighthouse 2.0 station: where it stands, what it announces and what it is.
struct Lh2SimStation {
  RoomFromStation pose;
  std::uint32_t id = 0;
  int channel = 0;
  std::array<PlaneErrors, 2> announced;
  std::array<PlaneErrors, 2> actual;
  double rate = 1.0;  // of its clock against true time
};

/// Lighthouse 2.0 stations and a target before them: the changes of the receivers' outputs in the order of time. The
/// same scenario and seed give the same changes. README.md describes the model.
class Lh2Simulator {
 public:
  /// `scenario.generation` must be 2.
  Lh2Simulator(LighthouseScenario scenario, std::uint64_t seed);
  Lh2Simulator(const Lh2Simulator&) = delete;
  Lh2Simulator& operator=(const Lh2Simulator&) = delete;

  /// The next change; empty at the scenario's end.
  std::optional<LightChange> next();

  /// T_room_body at a counter time.
  RoomFromBody truth(double counter_s) const { return scenario_.trajectory->at(clock_.true_time(counter_s)); }
  double start_s() const { return clock_.counter_time(0.0); }
  double end_s() const { return clock_.counter_time(scenario_.duration_s); }
  const LighthouseScenario& scenario() const { return scenario_; }
  const TargetClock& clock() const { return clock_; }
  const std::vector<Lh2SimStation>& stations() const { return stations_; }
  const Target& nominal_target() const { return scenario_.target; }
  const Target& true_target() const { return true_target_; }
  /// Passes so far, not strictly in the order of time, and faults likewise.
  const std::vector<LightPass>& passes() const { return passes_; }
  const std::vector<InjectedFault>& faults() const { return faults_; }

 private:
  struct Turning {
    double sync_s = 0.0;  // true time of the next turn's sync
    double period_s = 0.0;
    std::vector<bool> frame;  // OOTX
    std::size_t bit = 0;
    std::array<std::vector<bool>, 2> code;
  };
  // One thing that happens at a receiver: the level changes, or light begins or ends.
  struct Event {
    double time_s = 0.0;
    std::uint64_t number = 0;
    std::size_t sensor = 0;
    int light = 0;  // +1 begins, -1 ends, 0: the data change
    bool operator>(const Event& other) const {
      return time_s != other.time_s ? time_s > other.time_s : number > other.number;
    }
  };
  struct Receiver {
    bool data = false;
    int lights = 0;
    double changed_s = -1.0;
    std::int64_t last_ticks = 0;
  };
  struct Light {
    std::size_t station = 0;
    std::size_t plane = 0;
    std::size_t sensor = 0;
    double sync_s = 0.0;
    double middle_s = 0.0;
    double length_s = 0.0;
    bool slow_bit = false;
  };

  void draw_stations(std::uint64_t seed);
  void draw_target(std::uint64_t seed);
  void draw_hands();
  void simulate_turn(std::size_t station);
  std::optional<double> hit_time(std::size_t station, std::size_t plane, std::size_t sensor, double sync_s) const;
  void add_pass(Light light, bool reflection);
  void add_light(const Light& light);
  void add_noise(double from_s, double to_s);
  bool blocked(std::size_t sensor, double time_s);
  void add_event(double time_s, std::size_t sensor, int light);
  std::optional<LightChange> take(const Event& event);
  void note(double time_s, const char* kind, int station, int sensor, double amount);

  LighthouseScenario scenario_;
  TargetClock clock_;
  RandomStream timing_;
  RandomStream noise_;
  RandomStream fault_random_;
  Target true_target_;
  std::vector<Lh2SimStation> stations_;
  std::vector<Turning> turning_;
  std::vector<Receiver> receivers_;
  std::vector<std::pair<Interval, std::vector<bool>>> hands_;
  std::priority_queue<Event, std::vector<Event>, std::greater<>> events_;
  std::uint64_t number_ = 0;
  double noise_until_s_ = 0.0;
  std::vector<LightPass> passes_;
  std::vector<InjectedFault> faults_;
};

/// The bytes that a station sends over OOTX: 43, protocol 8.
std::vector<std::uint8_t> lh2_announcement(const Lh2SimStation& station);
/// The errors as half precision keeps them.
PlaneErrors as_announced(const PlaneErrors& errors);

}  // namespace pharos::sim
