// SPDX-License-Identifier: Apache-2.0
#include "firmware/app/program.hpp"

#include "pharos/base/ticks.hpp"
#include "pharos/wire/hello_message.hpp"

namespace pharos::app {
namespace {

/// Records of one pass: some 0.5 ms of a 50 MHz core, so that the line is served in between.
constexpr int kRecordsAPass = 32;
/// Where records arrive one by one the line is not polled for each: a millisecond of it fills a third of the UART's
/// FIFOs.
constexpr std::int64_t kServe_ticks = kTicksPerSecond / 2000;
/// Interval at which the decoder gets the time when no record provides it.
constexpr std::int64_t kAdvance_ticks = kTicksPerSecond / 1000;
/// Maximum delay of raw edges while a frame fills.
constexpr std::int64_t kRawEdges_ticks = kTicksPerSecond / 20;
/// A line that accepts nothing for so long is broken, and with it the program: the longest frame takes 12 ms.
constexpr std::int64_t kLineStuck_ticks = kTicksPerSecond;
/// The solver must have been called within this time.
constexpr std::int64_t kSolverStuck_ticks = 2 * kTicksPerSecond;

/// Hello, counters and the time for a second: an image that sends these works.
constexpr std::uint32_t kConfirmed_frames = 12;

constexpr std::uint8_t modes_of(const PoseSolver* solver) {
  return static_cast<std::uint8_t>(wire::kModeSweeps | (solver != nullptr ? wire::kModePoses : 0));
}

}  // namespace

Program::Program(const hal::Board& board, PoseSolver* solver)
    : board_(board),
      solver_(solver),
      commands_(static_cast<std::uint8_t>(modes_of(solver) | wire::kModeRawEdges), modes_of(solver)),
      line_(board.line) {
  now_ticks_ = board_.capture.now_ticks();
  edges_.note_time(now_ticks_);
  schedule_.start(now_ticks_);
  served_ticks_ = advanced_ticks_ = flushed_ticks_ = line_free_ticks_ = solver_seen_ticks_ = busy_since_ticks_ =
      now_ticks_;
}

bool Program::poll() {
  const std::uint32_t begin = board_.system.cycles();
  bool busy = capture();
  if (!busy || now_ticks_ - served_ticks_ >= kServe_ticks) {
    served_ticks_ = now_ticks_;
    busy = receive() || busy;
    busy = send() || busy;
    kick_watchdog();
  }
  const bool counted_there = solver_ != nullptr && solver_->solving();
  if (busy && !counted_there) busy_cycles_ += board_.system.cycles() - begin;
  return busy;
}

bool Program::receive() {
  bool any = false;
  while (const auto byte = board_.line.read()) {
    any = true;
    commands_.push(*byte);
  }
  return any;
}

bool Program::capture() {
  now_ticks_ = board_.capture.now_ticks();  // before the records: those stamped until now are all behind it
  hal::CaptureRecord record;
  for (int i = 0; i < kRecordsAPass; ++i) {
    if (!board_.capture.read(record)) {
      if (now_ticks_ - advanced_ticks_ >= kAdvance_ticks) {
        advanced_ticks_ = now_ticks_;
        edges_.note_time(now_ticks_ - hal::EdgeCapture::kSettle_ticks);
        decoder_.advance(now_ticks_ - hal::EdgeCapture::kSettle_ticks);
      }
      return i != 0;
    }
    edges_.push(record, [this](const lighthouse::Edge& edge) { take(edge); });
  }
  return true;
}

void Program::take(const lighthouse::Edge& edge) {
  decoder_.push(edge);
  if (has_mode(wire::kModeRawEdges)) report_raw(edge);
}

[[gnu::noinline]] void Program::report_raw(lighthouse::Edge edge) {
  if (hold(edge)) return;
  // The frame is full. It is sent as soon as the line is free; until then edges do not fit.
  if (line_.free()) {
    flushed_ticks_ = now_ticks_;
    line_.send(reporter_.flush_edges());
    hold(edge);
  } else {
    ++raw_edges_lost_;
  }
}

bool Program::hold(const lighthouse::Edge& edge) {
  return reporter_.hold(edge, raw_edges_lost_ + board_.capture.edges_lost());
}

bool Program::send() {
  bool any = false;
  while (line_.free()) {
    line_free_ticks_ = now_ticks_;
    const report::Reporter::Bytes frame = next_frame();
    if (frame.empty()) break;
    line_.send(frame);
    any = true;
  }
  return any;
}

report::Reporter::Bytes Program::next_frame() {
  if (commands_.take_identify()) schedule_.want_hello();
  if (commands_.has_answer() && line_.frames() != 0) return answer();  // Hello is the first frame of all
  // Alternately, so that a Hello and two sets of counters in a row never delay the few sweeps that can be queued.
  if (reported_) {
    reported_ = false;
    if (const auto frame = next_result(); !frame.empty()) return frame;
  }
  const Due due = schedule_.next(now_ticks_);
  reported_ = due != Due::kNothing;
  return reported_ ? say(due) : next_result();
}

report::Reporter::Bytes Program::next_result() {
  // Sweeps that the host did not request are taken all the same: the decoder holds only four, and the solver needs
  // them.
  while (const lighthouse::Sweep* sweep = decoder_.next_sweep()) {
    const report::Reporter::Bytes frame = reported(*sweep);
    decoder_.drop_sweep();
    if (has_mode(wire::kModeSweeps)) return frame;
  }
  while (const lighthouse::OotxPayload* payload = decoder_.next_ootx()) {
    const report::Reporter::Bytes frame = reported(*payload);
    decoder_.drop_ootx();
    if (has_mode(wire::kModeSweeps)) return frame;
  }
  if (solver_ != nullptr && has_mode(wire::kModePoses)) {
    if (const auto frame = solver_->next_frame(reporter_); !frame.empty()) return frame;
  }
  if (now_ticks_ - flushed_ticks_ >= kRawEdges_ticks) {
    flushed_ticks_ = now_ticks_;
    return reporter_.flush_edges();
  }
  return {};
}

template <class Result>
report::Reporter::Bytes Program::reported(const Result& result) {
  if (solver_ != nullptr) solver_->take(result);
  return has_mode(wire::kModeSweeps) ? reporter_.report(result) : report::Reporter::Bytes{};
}

// Never inlined: the decoder's path must not carry the messages on its stack.
[[gnu::noinline]] report::Reporter::Bytes Program::say(Due what) {
  switch (what) {
    case Due::kHello:
      return hello();
    case Due::kDecoderCounters:
      return reporter_.report(report::DecoderReport{now_ticks_, decoder_.counters()});
    case Due::kDeviceCounters:
      return device_counters();
    case Due::kTime:
      return reporter_.report_time(board_.capture.now_ticks());
    case Due::kNothing:
      break;
  }
  return {};
}

report::Reporter::Bytes Program::hello() {
  wire::Hello hello;
  hello.role = wire::Role::kDecoder;
  hello.reset_cause = board_.system.reset_cause();
  hello.modes = commands_.modes();
  hello.firmware_major = PHAROS_VERSION_MAJOR;
  hello.firmware_minor = PHAROS_VERSION_MINOR;
  hello.firmware_patch = PHAROS_VERSION_PATCH;
  hello.start_count = board_.system.start_count();
  hello.tick_rate_hz = static_cast<std::uint32_t>(kTicksPerSecond);
  hello.sensors = board_.capture.inputs();
  hello.time_ticks = now_ticks_;
  hello.unique_id = board_.system.unique_id();
  hello.board = wire::Text<24>(board_.system.board_name());
  return reporter_.send(hello);
}

report::Reporter::Bytes Program::device_counters() {
  if (board_.capture.take_overflow()) ++overflows_;
  if (solver_ != nullptr) busy_cycles_ += solver_->take_busy_cycles();
  wire::DeviceCounters counters;
  counters.capture_overflows = overflows_;
  counters.edges_lost = board_.capture.edges_lost();
  counters.frames_sent = line_.frames();
  counters.frames_skipped = schedule_.skipped() + decoder_.counters().outputs_overflow;
  if (solver_ != nullptr) counters.poses_skipped = solver_->sweeps_missed();
  counters.commands = commands_.executed();
  counters.commands_refused = commands_.refused();
  counters.receive_errors = board_.line.receive_errors() + commands_.damaged();
  const auto elapsed = static_cast<std::uint32_t>(now_ticks_ - busy_since_ticks_);
  constexpr std::uint32_t kTicksPerMillisecond = kTicksPerSecond / 1000;
  const std::uint32_t thousandth_cycles = elapsed / kTicksPerMillisecond * (board_.system.clock_hz() / 1000) / 1000;
  if (thousandth_cycles != 0) counters.busy_permille = busy_cycles_ / thousandth_cycles;
  counters.stack_free_bytes = board_.system.stack_never_used_bytes();
  busy_cycles_ = 0;
  busy_since_ticks_ = now_ticks_;
  return reporter_.report(report::DeviceReport{now_ticks_, counters});
}

report::Reporter::Bytes Program::answer() {
  const Reply answer = commands_.take_answer();
  if (!answer.refused) return reporter_.send(wire::Ack{answer.for_type, answer.for_sequence, answer.value});
  return reporter_.send(wire::Nak{answer.for_type, answer.for_sequence, *answer.refused, answer.value});
}

void Program::kick_watchdog() {
  const Commands::Restart wanted = commands_.restart();
  if (wanted != Commands::Restart::kNone && line_.silent()) {
    board_.system.restart(wanted == Commands::Restart::kLoader);
  }
  if (solver_ == nullptr || solver_->take_alive()) solver_seen_ticks_ = now_ticks_;
  const bool line_moves = now_ticks_ - line_free_ticks_ < kLineStuck_ticks;
  const bool solver_moves = now_ticks_ - solver_seen_ticks_ < kSolverStuck_ticks;
  if (!line_moves || !solver_moves) return;
  board_.system.feed_watchdog();
  if (line_.frames() >= kConfirmed_frames) board_.system.confirm_start();
}

}  // namespace pharos::app
