// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tools/sim/pseudo_terminal.hpp"
#include "tools/sim/pulse_feed.hpp"
#include "tools/sim/random_stream.hpp"
#include "tools/sim/simulated_target.hpp"
#include "tools/sim/truth_log.hpp"

namespace pharos::sim {

/// Times at which the port is unplugged and for how long, s since the start of play.
struct Unplug {
  double at_s = 0.0;
  double for_s = 1.0;
};

struct SerialOptions {
  double speed = 1.0;         // times real speed; 0: as fast as the line accepts it
  double baud = 460'800;      // of the line, at real speed; 10 bits a byte
  double corrupt_rate = 0.0;  // of bytes: one bit flipped
  double drop_rate = 0.0;     // of bytes: lost
  std::vector<Unplug> unplugs;
  bool wait_for_reader = true;
  std::uint64_t seed = 1;
};

/// Statistics of a playback.
struct SerialSummary {
  double played_s = 0.0;
  std::uint64_t pulses = 0;
  std::uint64_t bytes = 0;
  std::uint64_t bytes_unheard = 0;  // sent while the port was not open
  std::uint64_t frames_skipped = 0;
  std::uint64_t bytes_corrupted = 0;
  std::uint64_t bytes_dropped = 0;
  std::uint32_t sweeps = 0;
  std::uint32_t payloads = 0;
  bool stopped = false;  // by a signal
};

/// Plays light through a simulated target into a pseudo-terminal, at real speed or another.
class SerialPlayer {
 public:
  SerialPlayer(LightFeed& feed, const PlayClock& clock, SimulatedTarget& target, PseudoTerminal& line,
               const SerialOptions& options, std::optional<PlayTruth> truth);

  /// Runs until the recording ends or SIGINT or SIGTERM arrives (which are blocked for the process in this time).
  SerialSummary play();

 private:
  bool wait_for_reader();
  void play_until(double time_s);
  void unplug_or_plug_in(double time_s);
  void notice_reader();
  void send(std::size_t budget_bytes);
  void damage(std::vector<std::uint8_t>& bytes);
  void drain();
  bool sleep_or_signal(double seconds);
  double elapsed_s() const;

  LightFeed& feed_;
  const PlayClock& clock_;
  SimulatedTarget& target_;
  PseudoTerminal& line_;
  SerialOptions options_;
  std::optional<TruthLog> truth_;
  RandomStream random_;
  SerialSummary summary_;
  std::vector<std::uint8_t> sending_;  // rest of the current frame, which the kernel has not accepted yet
  double byte_credit_ = 0.0;
  bool had_reader_ = false;
  std::size_t unplugs_done_ = 0;
  bool unplugged_ = false;
  std::int64_t start_ns_ = 0;  // monotonic
};

}  // namespace pharos::sim
