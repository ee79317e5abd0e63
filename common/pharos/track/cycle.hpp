// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "pharos/lighthouse/bearing.hpp"

namespace pharos::track {

/// One cycle of one station: the raw bearings of its x sweep and of the y sweep that follows. Either may be missing (no
/// flash seen, no lock); then it has no bearings.
struct Cycle {
  std::uint8_t station = 0;
  std::uint8_t sweep_flags = 0;       // of lighthouse::SweepFlag, of either sweep
  std::int64_t last_flash_ticks = 0;  // of the sweeps it holds
  std::array<bool, kAxes> has_sweep{};
  std::array<lighthouse::SweepBearings, kAxes> bearings;

  const lighthouse::SweepBearings& operator[](Axis axis) const {
    return bearings[static_cast<std::size_t>(index_of(axis))];
  }
};

/// Joins the sweeps of one station to cycles. X opens a cycle and Y closes it; a sweep that does not fit closes what
/// was open, so that nothing is delayed by more than one rotor revolution and nothing is lost.
class CycleAssembler {
 public:
  /// Maximum time between the two flashes of a cycle: they are half a revolution apart, in every mode.
  static constexpr std::int64_t kMaxGap_ticks = 600'000;  // 0.72 revolutions

  /// The cycle that this sweep completed, if any.
  std::optional<Cycle> push(std::uint8_t station, Axis axis, std::int64_t flash_ticks, std::uint8_t sweep_flags,
                            const lighthouse::SweepBearings& bearings);
  /// The same in two steps and without a copy, for callers without memory for one: first the cycle that such a sweep
  /// would close, else null ...
  const Cycle* close_before(Axis axis, std::int64_t flash_ticks);
  /// ... then the sweep itself: the cycle that it completed, valid until the next sweep, else null. `may_complete`:
  /// false when close_before() returned one. The sweep then waits for its own partner or for the next one.
  const Cycle* add(std::uint8_t station, Axis axis, std::int64_t flash_ticks, std::uint8_t sweep_flags,
                   const lighthouse::SweepBearings& bearings, bool may_complete);
  /// What is still open, if anything.
  std::optional<Cycle> flush();

 private:
  bool fits(Axis axis, std::int64_t flash_ticks) const;

  Cycle open_;
  bool is_open_ = false;
};

}  // namespace pharos::track
