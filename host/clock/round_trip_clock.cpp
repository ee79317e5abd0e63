// SPDX-License-Identifier: Apache-2.0
#include "host/clock/round_trip_clock.hpp"

#include <algorithm>
#include <cmath>

namespace pharos::host {
namespace {

/// So many trips in a row outside the bounds, over this time, and the other clock was set.
constexpr int kContradictingTrips = 4;
constexpr std::int64_t kContradictingSpan_ns = 300'000'000;
/// Beyond the bounds by less is no contradiction: reading two clocks, and lines that are fitted.
constexpr double kTolerance_ns = 50e3;
/// Relative drift of two crystals while none is estimated (LowerEnvelope holds it at 0 for 2 s), and how well a long
/// fit knows it: temperature changes.
constexpr double kUnknownDrift_ns_per_s = 100e3;
constexpr double kDriftSigma_ns_per_s = 500.0;
/// Reading a clock and a message's microseconds.
constexpr double kReading_ns = 1e3;
/// 2096: differences of times up to here fit into 64 bits.
constexpr std::int64_t kMaxTime_ns = 4'000'000'000'000'000'000;
/// An answer that waits longer in the other computer, or a trip that takes longer, is of no use.
constexpr std::int64_t kMaxTrip_ns = 2'000'000'000;

}  // namespace

double RoundTripClock::seconds(std::int64_t monotonic_ns) const {
  return static_cast<double>(monotonic_ns - first_ns_) * 1e-9;
}

void RoundTripClock::restart() {
  there_.clear();
  back_.clear();
  trips_ = 0;
  contradicting_run_ = 0;
}

void RoundTripClock::begin(const RoundTrip& trip) {
  restart();
  base_ns_ = trip.received_ns - trip.asked_ns;
  first_ns_ = trip.asked_ns;
}

// Theta is above -down and below up, old and new.
bool RoundTripClock::contradicts(double time_s, double up_ns, double down_ns) const {
  if (trips_ == 0) return false;
  const double age_s = std::abs(time_s - seconds(newest_ns_));
  const double tolerance_ns =
      kTolerance_ns + 3.0 * (up_.scatter_ns + down_.scatter_ns) +
      age_s * (up_.drift_ns_per_s == 0.0 ? 2.0 * kUnknownDrift_ns_per_s : 10.0 * kDriftSigma_ns_per_s);
  return up_ns < -down_.value(time_s) - tolerance_ns || down_ns < -up_.value(time_s) - tolerance_ns;
}

RoundTripClock::Result RoundTripClock::add(const RoundTrip& trip) {
  const std::int64_t away_ns = trip.returned_ns - trip.asked_ns;
  const bool ordered = trip.received_ns >= 0 && trip.answered_ns >= trip.received_ns && trip.answered_ns <= kMaxTime_ns;
  if (!ordered || trip.answered_ns - trip.received_ns > kMaxTrip_ns || away_ns < 0 || away_ns > kMaxTrip_ns) {
    return Result::kImpossible;
  }
  if (trips_ == 0) begin(trip);
  const auto up_ns = static_cast<double>(trip.received_ns - trip.asked_ns - base_ns_);
  const auto down_ns = static_cast<double>(trip.returned_ns - trip.answered_ns + base_ns_);
  if (contradicts(seconds(trip.returned_ns), up_ns, down_ns)) {
    ++contradictions_;
    if (++contradicting_run_ == 1) contradicting_since_ns_ = trip.asked_ns;
    const bool proved = contradicting_run_ >= kContradictingTrips &&
                        trip.returned_ns - contradicting_since_ns_ >= kContradictingSpan_ns;
    if (!proved) return Result::kContradiction;
    ++steps_;
    begin(trip);
    return add(trip);
  }
  contradicting_run_ = 0;
  ++trips_;
  newest_ns_ = trip.returned_ns;
  there_.add(seconds(trip.asked_ns), up_ns);
  back_.add(seconds(trip.returned_ns), down_ns);
  up_ = *there_.fit();
  down_ = *back_.fit();
  return Result::kUsed;
}

double RoundTripClock::offset_ns(double time_s) const { return 0.5 * (up_.value(time_s) - down_.value(time_s)); }

double RoundTripClock::sigma_at(double time_s) const {
  const double newest_s = seconds(newest_ns_);
  const double width_ns = std::max(0.0, up_.value(newest_s) + down_.value(newest_s));
  const double span_s = std::min(up_.span_s, down_.span_s);
  const double scatter_ns = 0.5 * (up_.scatter_ns + down_.scatter_ns);
  const bool knows_drift = up_.drift_ns_per_s != 0.0 || down_.drift_ns_per_s != 0.0;
  const double drift_ns_per_s =
      knows_drift ? kDriftSigma_ns_per_s + scatter_ns / std::max(span_s, 1.0) : kUnknownDrift_ns_per_s;
  const double apart_s = std::abs(time_s - newest_s) + (knows_drift ? 0.0 : span_s);
  return width_ns / std::sqrt(12.0) + scatter_ns + drift_ns_per_s * apart_s + kReading_ns;
}

std::optional<OwnTime> RoundTripClock::own_time(std::int64_t other_ns, std::int64_t monotonic_ns) const {
  const bool known = trips_ >= kMinTrips && newest_ns_ - first_ns_ >= kMinSpan_ns && contradicting_run_ == 0;
  if (!known || monotonic_ns - newest_ns_ > kMaxAge_ns || other_ns < 0 || other_ns > kMaxTime_ns) {
    return std::nullopt;
  }
  const std::int64_t near_ns = other_ns - base_ns_;  // on this clock, apart from the drift since the first trip
  if (std::abs(near_ns - newest_ns_) > kMaxAge_ns) return std::nullopt;
  const double time_s = seconds(near_ns);
  return OwnTime{near_ns - std::llround(offset_ns(time_s)), std::llround(sigma_at(time_s))};
}

double RoundTripClock::drift_ppm() const {
  return trips_ == 0 ? 0.0 : 0.5e-3 * (up_.drift_ns_per_s - down_.drift_ns_per_s);
}

std::int64_t RoundTripClock::sigma_ns() const { return trips_ == 0 ? 0 : std::llround(sigma_at(seconds(newest_ns_))); }

std::int64_t RoundTripClock::round_trip_ns() const {
  const double newest_s = seconds(newest_ns_);
  return trips_ == 0 ? 0 : std::llround(std::max(0.0, up_.value(newest_s) + down_.value(newest_s)));
}

}  // namespace pharos::host
