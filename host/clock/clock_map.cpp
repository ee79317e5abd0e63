// SPDX-License-Identifier: Apache-2.0
#include "host/clock/clock_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "pharos/base/ticks.hpp"

namespace pharos::host {
namespace {

/// Bytes that were buffered in the kernel before the port was opened all arrive at once: no mapping until pairs span
/// this time.
constexpr std::int64_t kMinArrivalSpan_ns = 200'000'000;
/// A pair this far under the line does not have a smaller latency but belongs to another mapping...
constexpr double kLargestDrop_ns = 50e6;
/// ...unless the mapping is younger than this, so that all its pairs may have been late, and two pairs in a row agree.
constexpr double kYoung_s = 2.0;
/// Frames arrive in the order of sending, with times of the last few slots; older times are from another counter.
constexpr std::int64_t kLargestDisorder_ticks = kTicksPerSecond / 4;
/// The host may stall; longer than this, the line's buffers would have overflown.
constexpr double kLargestStall_ns = 5e9;
/// A candidate mapping replaces the present one with this many pairs over this time that agree to this.
constexpr int kCandidatePairs = 3;
constexpr std::int64_t kCandidateSpan_ns = 300'000'000;
constexpr double kCandidateAgreement_ns = 0.5e9;
/// A change of UTC against the monotonic clock above this is a step, once three pairs in a row show it.
constexpr std::int64_t kStep_ns = 1'000'000;
constexpr int kStepPairs = 3;
/// Latency assumed while it is not known: half of the 10 ms for which serial adapters buffer bytes.
constexpr double kExpectedExcess_ns = 5e6;
/// Time constant of the average latency, in pairs.
constexpr double kExcessMemory = 1000.0;
/// Time for reading two clocks and for waking the process.
constexpr double kFloor_ns = 2e3;
constexpr double kUnknownDrift = 100e-6;

double seconds_between(std::int64_t later_ticks, std::int64_t earlier_ticks) {
  return ticks_to_seconds(later_ticks - earlier_ticks);
}

}  // namespace

void ClockMap::begin(std::int64_t ticks, std::int64_t monotonic_ns, std::int64_t arrival_monotonic_ns) {
  envelope_.clear();
  utc_.restart();
  started_ = true;
  synchronised_ = false;
  first_ticks_ = newest_ticks_ = ticks;
  first_monotonic_ns_ = monotonic_ns;
  first_arrival_ns_ = arrival_monotonic_ns;
  excess_sum_ns_ = excess_count_ = 0.0;
  candidate_pairs_ = 0;
  drop_ns_.reset();
  line_ = {};
}

void ClockMap::restart() {
  if (started_) ++counters_.resynchronised;
  started_ = false;
  synchronised_ = false;
  utc_.restart();
}

bool ClockMap::fits(std::int64_t ticks, double delay_ns, double time_s) {
  if (ticks < newest_ticks_ - kLargestDisorder_ticks) return false;
  const double above_ns = delay_ns - line_.value(time_s);
  if (above_ns > -kLargestDrop_ns) {
    drop_ns_.reset();
    return above_ns < kLargestStall_ns;
  }
  const bool second_in_a_row = drop_ns_ && std::abs(*drop_ns_ - delay_ns) < kCandidateAgreement_ns;
  drop_ns_ = delay_ns;
  return line_.span_s < kYoung_s && above_ns > -kLargestStall_ns && second_in_a_row;
}

bool ClockMap::repeats(double delay_ns, std::int64_t arrival_monotonic_ns) {
  if (candidate_pairs_ == 0 || std::abs(delay_ns - candidate_delay_ns_) > kCandidateAgreement_ns) {
    candidate_pairs_ = 0;
    candidate_since_ns_ = arrival_monotonic_ns;
  }
  candidate_delay_ns_ = delay_ns;
  ++candidate_pairs_;
  return candidate_pairs_ >= kCandidatePairs && arrival_monotonic_ns - candidate_since_ns_ >= kCandidateSpan_ns;
}

void ClockMap::follow_utc(std::int64_t offset_ns) {
  const std::int64_t change_ns = offset_ns - offset_ns_;
  if (!offset_known_) {
    offset_known_ = true;
    offset_ns_ = offset_ns;
  } else if (std::abs(change_ns) < kStep_ns) {
    offset_ns_ += change_ns / 4;
    offset_outliers_ = 0;
  } else if (++offset_outliers_ >= kStepPairs) {
    offset_ns_ = offset_ns;
    offset_outliers_ = 0;
    ++counters_.host_steps;
    if (!utc_.would_jump(change_ns)) return;
    ++counters_.host_jumps;
    last_jump_ns_ = change_ns;
    utc_.reset();
  }
}

bool ClockMap::add(std::int64_t ticks, std::int64_t arrival_utc_ns, std::int64_t arrival_monotonic_ns,
                   std::int64_t certain_latency_ns) {
  follow_utc(arrival_utc_ns - arrival_monotonic_ns);
  const std::int64_t sent_ns = arrival_monotonic_ns - certain_latency_ns;
  if (!started_) begin(ticks, sent_ns, arrival_monotonic_ns);
  double time_s = seconds_between(ticks, first_ticks_);
  double delay_ns = static_cast<double>(sent_ns - first_monotonic_ns_ - ticks_to_nanoseconds(ticks - first_ticks_));
  if (!fits(ticks, delay_ns, time_s)) {
    if (!repeats(delay_ns, arrival_monotonic_ns)) {
      ++counters_.pairs_ignored;
      return false;
    }
    ++counters_.resynchronised;
    begin(ticks, sent_ns, arrival_monotonic_ns);
    time_s = delay_ns = 0.0;
  }
  candidate_pairs_ = 0;
  ++counters_.pairs;
  envelope_.add(time_s, delay_ns);
  line_ = *envelope_.fit();
  if (excess_count_ >= kExcessMemory) {
    excess_sum_ns_ /= 2.0;
    excess_count_ /= 2.0;
  }
  excess_sum_ns_ += std::max(0.0, delay_ns - line_.value(time_s));
  excess_count_ += 1.0;
  newest_ticks_ = std::max(newest_ticks_, ticks);
  synchronised_ = synchronised_ || arrival_monotonic_ns - first_arrival_ns_ >= kMinArrivalSpan_ns;
  if (synchronised_) {
    utc_.steer(ticks_to_nanoseconds(newest_ticks_), monotonic_of(newest_ticks_) + offset_ns_,
               1.0 + line_.drift_ns_per_s * 1e-9);
  }
  return true;
}

std::int64_t ClockMap::monotonic_of(std::int64_t ticks) const {
  const double delay_ns = line_.value(seconds_between(ticks, first_ticks_));
  return first_monotonic_ns_ + ticks_to_nanoseconds(ticks - first_ticks_) + std::llround(delay_ns);
}

std::int64_t ClockMap::sigma_ns() const {
  if (!synchronised_) return -1;
  // The line touches its lowest points: the error of the floor decreases with the number of pairs.
  const double excess_ns = (excess_sum_ns_ + kExpectedExcess_ns) / (excess_count_ * excess_count_);
  const double drift_ns = line_.drift_ns_per_s == 0.0 ? kUnknownDrift * line_.span_s * 1e9 : 0.0;
  const double steering_ns = std::abs(static_cast<double>(utc_.remaining_ns()));
  return std::llround(steering_ns + line_.scatter_ns + excess_ns + drift_ns + kFloor_ns);
}

std::optional<MappedTime> ClockMap::map(std::int64_t ticks) {
  if (!synchronised_ || candidate_pairs_ > 0) return std::nullopt;
  const auto utc_ns = utc_.read(ticks_to_nanoseconds(ticks));
  if (!utc_ns) return std::nullopt;
  return MappedTime{*utc_ns, monotonic_of(ticks), sigma_ns()};
}

}  // namespace pharos::host
