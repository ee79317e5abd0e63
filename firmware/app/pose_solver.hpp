// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "pharos/lighthouse/ootx_payload.hpp"
#include "pharos/lighthouse/sweep.hpp"
#include "pharos/report/reporter.hpp"

namespace pharos::app {

/// The program's interface to a pose solver (pose_task.hpp); a build without poses has none and links nothing.
class PoseSolver {
 public:
  /// Every sweep and payload of the decoder, from inside poll().
  virtual void take(const lighthouse::Sweep& sweep) = 0;
  virtual void take(const lighthouse::OotxPayload& payload) = 0;
  /// The frame of the oldest result in the queue; empty when there is none.
  virtual report::Reporter::Bytes next_frame(report::Reporter& reporter) = 0;
  /// Sweeps of uncalibrated stations and sweeps dropped before their cycle was solved; since start.
  virtual std::uint32_t sweeps_missed() = 0;
  /// Processor clocks spent since the last call, those of interrupts in between included.
  virtual std::uint32_t take_busy_cycles() = 0;
  /// Whether the caller interrupts a solve, whose clocks are counted there.
  virtual bool solving() = 0;
  /// Whether the solver was called since the last query: one solve may take a quarter of a second.
  virtual bool take_alive() = 0;

 protected:
  ~PoseSolver() = default;
};

}  // namespace pharos::app
