// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "host/clock/lower_envelope.hpp"

namespace pharos::host {

/// One question to another computer and its answer, nanoseconds: sent and returned on this computer's monotonic clock,
/// received and answered on the other one's.
struct RoundTrip {
  std::int64_t asked_ns = 0;
  std::int64_t received_ns = 0;
  std::int64_t answered_ns = 0;
  std::int64_t returned_ns = 0;
};

/// An instant of the other computer's clock on this computer's monotonic clock.
struct OwnTime {
  std::int64_t monotonic_ns = 0;
  std::int64_t sigma_ns = 0;  // 1 sigma
};

/// The relation of two computers' clocks from round trips, whatever their delays.
///
/// With the offset theta (other minus own) each trip tells received - asked = theta + d1 and answered - returned =
/// theta - d2, with delays d1, d2 >= 0 (Mills, RFC 5905, section 8). So theta lies below all of the first and above all
/// of the second: each way's line under all delays (LowerEnvelope) is a bound, with the clocks' drift. The estimate is
/// the middle of both bounds. Where in between theta is depends on how the smallest round trip is divided, which
/// nothing tells: any division is equally probable, so sigma is the bounds' distance over sqrt(12), and the error is at
/// most 1.73 of it, apart from the jitter of both lines, which is added.
class RoundTripClock {
 public:
  enum class Result : std::uint8_t {
    kUsed,
    kImpossible,    // answered before it was received, or back before it was sent: not used
    kContradiction  // lies outside both bounds: not used; several in a row begin a new relation
  };
  Result add(const RoundTrip& trip);

  /// Empty until kMinTrips trips span kMinSpan_ns, while trips contradict the relation, and kMaxAge_ns after the last
  /// one, and for times more than kMaxAge_ns from it.
  std::optional<OwnTime> own_time(std::int64_t other_ns, std::int64_t monotonic_ns) const;

  /// Forgets the relation.
  void restart();

  /// Of the relation at the newest trip; 0 while there is none. Rate of the other clock against this one, parts per
  /// million; positive: the other one is faster.
  double drift_ppm() const;
  std::int64_t sigma_ns() const;
  /// Smallest round trip in sight, ns.
  std::int64_t round_trip_ns() const;
  std::int64_t contradictions() const { return contradictions_; }
  /// New relations after contradictions: the other clock was set.
  std::int64_t steps() const { return steps_; }

  static constexpr int kMinTrips = 4;
  static constexpr std::int64_t kMinSpan_ns = 400'000'000;
  static constexpr std::int64_t kMaxAge_ns = 10'000'000'000;

 private:
  void begin(const RoundTrip& trip);
  bool contradicts(double time_s, double up_ns, double down_ns) const;
  double seconds(std::int64_t monotonic_ns) const;
  double offset_ns(double time_s) const;
  double sigma_at(double time_s) const;

  LowerEnvelope there_, back_;  // theta + d1, -theta + d2
  LowerEnvelope::Line up_, down_;
  std::int64_t base_ns_ = 0;    // of theta, so that what is fitted is small
  std::int64_t first_ns_ = 0;   // monotonic
  std::int64_t newest_ns_ = 0;  // monotonic
  std::int64_t trips_ = 0;
  int contradicting_run_ = 0;
  std::int64_t contradicting_since_ns_ = 0;
  std::int64_t contradictions_ = 0;
  std::int64_t steps_ = 0;
};

}  // namespace pharos::host
