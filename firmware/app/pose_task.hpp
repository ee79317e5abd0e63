// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "firmware/app/pose_solver.hpp"
#include "firmware/hal/system.hpp"
#include "pharos/base/ring_buffer.hpp"
#include "pharos/track/epoch_tracker.hpp"
#include "pharos/tracking/calibrated_tracker.hpp"

namespace pharos::app {

/// Solves cycles on board, each warm-started from the last pose, while the program decodes from the timer's interrupt:
/// one solve from nothing takes longer than the capture block's FIFO lasts.
///
/// A station's cycles are solved once its calibration is known: without it every angle is 1 mrad off, and a search of
/// such a cycle for reflections takes this core seconds. Where the solver is behind, the oldest sweeps are dropped.
/// Both are counted.
///
/// take() and next_frame() run in the interrupt, solve() in the main loop; data between them is copied with interrupts
/// off.
class PoseTask final : public PoseSolver {
 public:
  PoseTask(hal::System& system, const Target& target);

  void take(const lighthouse::Sweep& sweep) override;
  void take(const lighthouse::OotxPayload& payload) override;
  report::Reporter::Bytes next_frame(report::Reporter& reporter) override;
  std::uint32_t sweeps_missed() override { return missed_; }
  std::uint32_t take_busy_cycles() override;
  bool solving() override { return solving_; }
  bool take_alive() override;

  /// Main loop: processes one sweep or payload. False when none is queued.
  bool solve();

 private:
  bool solve(const lighthouse::Sweep& sweep);
  void begin_solve();
  void count_until_now();
  void answer(const track::EpochResult& result);

  hal::System& system_;
  tracking::CalibratedTracker<track::EpochTracker> tracker_;
  /// Sweeps, dark ones among them, that come while a cycle is solved: four in two slots, and one.
  static constexpr std::size_t kWaiting = 5;

  RingBuffer<lighthouse::Sweep, kWaiting> sweeps_;
  RingBuffer<lighthouse::OotxPayload, 1> payloads_;
  RingBuffer<report::PoseReport, 1> answers_;
  std::uint32_t missed_ = 0;
  std::uint32_t busy_cycles_ = 0;
  std::uint32_t counted_until_cycles_ = 0;  // of the present solve
  volatile bool alive_ = false;
  volatile bool solving_ = false;
};

}  // namespace pharos::app
