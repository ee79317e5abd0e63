// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "pharos/base/static_vector.hpp"
#include "pharos/lighthouse/lh2_beam.hpp"

namespace pharos::lighthouse {

/// A beam's turn, and when that turn's sync was by this beam alone.
struct Lh2Placed {
  std::int64_t turn = 0;
  std::int64_t sync_sixths = 0;
};

/// The syncs of one channel's rotor from its beams alone: sync = time of a bit - its place / 6 MHz, once a turn.
///
/// The station's clock against ours is learnt from beams of one turn (some 10 ppm are 0.1 us between its two planes).
/// A rotor is found when two beams lead to one sync; a station that restarted is found anew in the same way.
class Lh2Rotor {
 public:
  /// Beams that wait for a second one.
  static constexpr std::size_t kMaxWaiting = 6;

  /// What became of a beam.
  struct Outcome {
    std::optional<Lh2Placed> placed;        // this beam fits
    std::optional<Lh2Beam> confirmed;       // and so does this earlier one, which waited
    std::optional<Lh2Placed> confirmed_at;  // where
    std::uint32_t dropped = 0;              // beams that waited too long
    bool found = false, lost = false;       // the rotor
  };

  Outcome push(const Lh2Beam& beam);
  /// Forgets what waits; how many.
  std::uint32_t flush();

  bool running() const { return running_; }
  /// Whether the rotor runs and the beam leads to its sync.
  bool fits(const Lh2Beam& beam) const { return running_ && place(beam).has_value(); }
  /// Rate of the station's clock against ours, 2^-30: a bit lasts 50 (1 + rate) sixths.
  std::int64_t rate_q30() const { return rate_q30_; }

 private:
  std::int64_t sync_of(const Lh2Beam& beam) const;
  std::optional<Lh2Placed> place(const Lh2Beam& beam) const;
  void take(const Lh2Beam& beam, const Lh2Placed& placed);
  void learn_rate(const Lh2Beam& beam);
  bool agree(const Lh2Beam& a, const Lh2Beam& b) const;
  void find(const Lh2Beam& beam, Outcome& outcome);

  bool running_ = false;
  Lh2Placed last_;     // the latest turn's
  Lh2Beam reference_;  // the latest turn's first beam
  std::int64_t turn_sixths_ = 0;
  std::int64_t rate_q30_ = 0;
  int rate_samples_ = 0;
  StaticVector<Lh2Beam, kMaxWaiting> waiting_;
};

}  // namespace pharos::lighthouse
