// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "firmware/app/commands.hpp"
#include "firmware/app/edge_stream.hpp"
#include "firmware/app/line_sender.hpp"
#include "firmware/app/pose_solver.hpp"
#include "firmware/app/schedule.hpp"
#include "firmware/hal/board.hpp"
#include "pharos/lighthouse/sorted_decoder.hpp"
#include "pharos/report/reporter.hpp"

namespace pharos::app {

/// The target's program except poses: capture -> decoder -> frames, commands -> replies, and periodic messages.
///
/// poll() does all pending work and never blocks. Called in a loop, or from an interrupt a thousand times a second; the
/// FIFO of the capture block bridges tens of milliseconds (firmware/rtl/README.md), so there is no ring after it.
class Program {
 public:
  /// `solver`: takes sweeps and provides poses, in builds that solve them; otherwise null.
  Program(const hal::Board& board, PoseSolver* solver);

  /// True when there was anything to do.
  bool poll();

 private:
  bool receive();
  bool capture();
  void take(const lighthouse::Edge& edge);
  void report_raw(lighthouse::Edge edge);
  bool hold(const lighthouse::Edge& edge);
  bool send();
  report::Reporter::Bytes next_frame();
  report::Reporter::Bytes next_result();
  template <class Result>
  report::Reporter::Bytes reported(const Result& result);
  report::Reporter::Bytes say(Due what);
  report::Reporter::Bytes hello();
  report::Reporter::Bytes device_counters();
  report::Reporter::Bytes answer();
  void kick_watchdog();
  bool has_mode(wire::HelloMode mode) const { return (commands_.modes() & mode) != 0; }

  hal::Board board_;
  PoseSolver* solver_;
  lighthouse::SortedDecoder decoder_;
  report::Reporter reporter_;
  Commands commands_;
  EdgeStream edges_;
  LineSender line_;
  Schedule schedule_;
  std::int64_t now_ticks_ = 0;
  std::int64_t served_ticks_ = 0;     // when line and watchdog were last served
  std::int64_t advanced_ticks_ = 0;   // of the last advance()
  std::int64_t flushed_ticks_ = 0;    // of the last frame of raw edges
  std::int64_t line_free_ticks_ = 0;  // when the line last took a whole frame
  std::int64_t solver_seen_ticks_ = 0;
  bool reported_ = false;  // the last frame was a periodic message
  std::uint32_t overflows_ = 0;
  std::uint32_t raw_edges_lost_ = 0;  // because the line was too slow
  std::uint32_t busy_cycles_ = 0;     // since the last report
  std::int64_t busy_since_ticks_ = 0;
};

}  // namespace pharos::app
