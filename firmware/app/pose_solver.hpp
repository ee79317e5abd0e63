// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "pharos/lighthouse/ootx_payload.hpp"
#include "pharos/lighthouse/sweep.hpp"
#include "pharos/report/reporter.hpp"

namespace pharos::app {

/// What the program asks of whoever solves poses (pose_task.hpp); a build without poses has nobody and links nothing.
class PoseSolver {
 public:
  /// Every sweep and payload of the decoder, from inside poll().
  virtual void take(const lighthouse::Sweep& sweep) = 0;
  virtual void take(const lighthouse::OotxPayload& payload) = 0;
  /// The frame of the oldest answer that waits; empty when none does.
  virtual report::Reporter::Bytes next_frame(report::Reporter& reporter) = 0;
  /// Sweeps of stations not calibrated and sweeps that gave way, so that their cycle was not answered; since start.
  virtual std::uint32_t sweeps_missed() = 0;
  /// Processor clocks spent since last asked, those of interrupts that came between among them.
  virtual std::uint32_t take_busy_cycles() = 0;
  /// Whether the caller interrupts a solve, whose clocks are counted there.
  virtual bool solving() = 0;
  /// Whether the solver has come by since last asked: one solve may take a quarter of a second.
  virtual bool take_alive() = 0;

 protected:
  ~PoseSolver() = default;
};

}  // namespace pharos::app
