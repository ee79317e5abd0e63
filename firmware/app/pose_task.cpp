// SPDX-License-Identifier: Apache-2.0
#include "firmware/app/pose_task.hpp"

#include <optional>

#include "firmware/hal/board.hpp"
#include "pharos/base/ticks.hpp"

namespace pharos::app {
namespace {

/// Three times the noise's chi-squared has one cycle in some hundred, for the flash's jitter is common to all sensors.
constexpr double kChi2ThresholdFactor = 4.0;
/// A search in double takes this core a tenth of a second for each start. In a pause of a second after one without
/// result the other station's cycles are solved.
constexpr int kSearchStarts = 4;
constexpr std::int64_t kSearchCooldown_ticks = kTicksPerSecond;

track::TrackOptions warm() {
  track::TrackOptions options;
  options.warm_start = true;
  options.solve.chi2_threshold_factor = kChi2ThresholdFactor;
  options.solve.max_search_starts = kSearchStarts;
  options.search_cooldown_ticks = kSearchCooldown_ticks;
  return options;
}

// What a station is not calibrated for is not searched: it would take this core seconds (pose_task.hpp).
tracking::CalibrationPolicy calibrated_only() {
  tracking::CalibrationPolicy policy;
  policy.answer_uncalibrated = false;
  return policy;
}

// The oldest entry of a ring that the interrupt fills.
template <class T, std::size_t N>
std::optional<T> take_oldest(RingBuffer<T, N>& ring) {
  const hal::NoInterrupts guard;
  if (ring.empty()) return std::nullopt;
  return ring.pop();
}

}  // namespace

PoseTask::PoseTask(hal::System& system, const Target& target)
    : system_(system), tracker_(calibrated_only(), target, warm()) {}

void PoseTask::take(const lighthouse::Sweep& sweep) {
  if (sweeps_.full()) {
    // All of them: dropping one at a time would leave incomplete cycles, which give no pose.
    missed_ += static_cast<std::uint32_t>(sweeps_.size());
    sweeps_.clear();
  }
  sweeps_.push(sweep);
}

void PoseTask::take(const lighthouse::OotxPayload& payload) {
  payloads_.push(payload);  // the station sends the same again in three seconds
}

report::Reporter::Bytes PoseTask::next_frame(report::Reporter& reporter) {
  if (answers_.empty()) return {};
  return reporter.report(answers_.pop());
}

std::uint32_t PoseTask::take_busy_cycles() {
  if (solving_) count_until_now();
  const std::uint32_t cycles = busy_cycles_;
  busy_cycles_ = 0;
  return cycles;
}

bool PoseTask::take_alive() {
  const bool alive = alive_;
  alive_ = false;
  return alive;
}

bool PoseTask::solve() {
  alive_ = true;
  if (const auto payload = take_oldest(payloads_)) {
    tracker_.push(*payload);
    return true;
  }
  const auto sweep = take_oldest(sweeps_);
  if (!sweep) return false;
  begin_solve();
  const bool calibrated = solve(*sweep);
  const hal::NoInterrupts guard;
  count_until_now();
  solving_ = false;
  if (!calibrated) ++missed_;
  return true;
}

void PoseTask::begin_solve() {
  const hal::NoInterrupts guard;
  counted_until_cycles_ = system_.cycles();
  solving_ = true;
}

// A solve may last over several reports: each gets its part.
void PoseTask::count_until_now() {
  const std::uint32_t now = system_.cycles();
  busy_cycles_ += now - counted_until_cycles_;
  counted_until_cycles_ = now;
}

// False where the station is not calibrated.
bool PoseTask::solve(const lighthouse::Sweep& sweep) {
  if (const auto result = tracker_.push(sweep)) answer(*result);
  return tracker_.effective_calibration(sweep.flash.station) != nullptr;
}

void PoseTask::answer(const track::EpochResult& result) {
  report::PoseReport report;
  report.station = result.station;
  report.flags = result.flags;
  report.time_ticks = result.time_ticks;
  report.observations = result.observations;
  report.pose = result.pose;
  const hal::NoInterrupts guard;
  if (!answers_.push(report)) ++missed_;
}

}  // namespace pharos::app
