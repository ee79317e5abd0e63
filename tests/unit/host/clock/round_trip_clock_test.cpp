// SPDX-License-Identifier: Apache-2.0
#include "host/clock/round_trip_clock.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace pharos::host {
namespace {

using Result = RoundTripClock::Result;

constexpr std::int64_t kMillis_ns = 1'000'000;
constexpr std::int64_t kSeconds_ns = 1'000'000'000;
constexpr std::int64_t kEpoch_ns = 1'700'000'000 * kSeconds_ns;

/// Another computer, whose clock is told by an offset and a drift, behind a network with known delays.
struct Peer {
  double offset_ns = 5e6;
  double drift = 20e-6;
  double there_ns = 100e3, back_ns = 100e3;  // least delays
  double jitter_ns = 50e3;                   // mean of what is added, exponential
  std::int64_t epoch_ns = kEpoch_ns;
  std::mt19937_64 random{1};

  std::int64_t time_at(std::int64_t own_ns) const {
    return epoch_ns + own_ns + std::llround(offset_ns + drift * static_cast<double>(own_ns));
  }
  RoundTrip trip(std::int64_t asked_ns) {
    std::exponential_distribution<double> jitter(1.0);
    RoundTrip trip;
    trip.asked_ns = asked_ns;
    const std::int64_t received_ns = asked_ns + std::llround(there_ns + jitter_ns * jitter(random));
    const std::int64_t answered_ns = received_ns + 20'000;
    trip.received_ns = time_at(received_ns);
    trip.answered_ns = time_at(answered_ns);
    trip.returned_ns = answered_ns + std::llround(back_ns + jitter_ns * jitter(random));
    return trip;
  }
};

class RoundTrips : public ::testing::Test {
 protected:
  // Eight trips a second.
  void run(double seconds) {
    for (int k = 0; k < static_cast<int>(8.0 * seconds); ++k) {
      now_ns += 125 * kMillis_ns;
      clock.add(peer.trip(now_ns));
    }
  }
  double error_ns() {
    const auto own = clock.own_time(peer.time_at(now_ns), now_ns);
    return own ? static_cast<double>(own->monotonic_ns - now_ns) : std::nan("");
  }
  double sigma_ns() { return static_cast<double>(clock.own_time(peer.time_at(now_ns), now_ns)->sigma_ns); }

  Peer peer;
  RoundTripClock clock;
  std::int64_t now_ns = 40 * kSeconds_ns;
};

TEST_F(RoundTrips, TellOffsetAndDrift) {
  run(60.0);
  EXPECT_LT(std::abs(error_ns()), 20e3);
  EXPECT_NEAR(clock.drift_ppm(), 20.0, 1.0);
  EXPECT_LT(sigma_ns(), 120e3) << "half of the smallest round trip, 220 us, over the root of three, and jitter";
  EXPECT_NEAR(static_cast<double>(clock.round_trip_ns()), 200e3, 30e3);
}

TEST_F(RoundTrips, TellNothingBeforeTheyAgree) {
  EXPECT_FALSE(clock.own_time(kEpoch_ns, 0).has_value());
  run(0.25);
  EXPECT_FALSE(clock.own_time(peer.time_at(now_ns), now_ns).has_value()) << "two trips";
  run(0.5);
  EXPECT_TRUE(clock.own_time(peer.time_at(now_ns), now_ns).has_value());
}

// The division of the delay is not observable: over many networks the error is as large as stated, in none beyond the
// bounds.
TEST_F(RoundTrips, SigmaHoldsForEveryDivisionOfTheDelay) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (const double jitter_ns : {5e3, 100e3, 1e6}) {
    for (const double seconds : {1.0, 5.0, 30.0}) {
      double squares = 0.0, largest = 0.0;
      constexpr int kNetworks = 200;
      for (int network = 0; network < kNetworks; ++network) {
        peer = Peer{};
        peer.random.seed(static_cast<std::uint64_t>(network));
        peer.offset_ns = (uniform(random) - 0.5) * 20e9;
        peer.drift = (uniform(random) - 0.5) * 200e-6;
        peer.jitter_ns = jitter_ns;
        peer.there_ns = uniform(random) * 1e6;
        peer.back_ns = 1e6 - peer.there_ns;
        clock = RoundTripClock();
        run(seconds);
        const double normalised = std::abs(error_ns()) / sigma_ns();
        squares += normalised * normalised;
        largest = std::max(largest, normalised);
      }
      const double mean = squares / kNetworks;
      EXPECT_LT(mean, 1.1) << "jitter " << jitter_ns << " ns, " << seconds << " s";
      EXPECT_LT(largest, 2.0) << "jitter " << jitter_ns << " ns, " << seconds << " s";
      if (jitter_ns < 50e3 && seconds > 2.0) {
        EXPECT_GT(mean, 0.6) << "stated as it is, where nothing but the division is unknown";
      }
    }
  }
}

TEST_F(RoundTrips, StallsChangeNothing) {
  run(20.0);
  const double before_ns = error_ns();
  for (int k = 0; k < 80; ++k) {
    now_ns += 125 * kMillis_ns;
    RoundTrip trip = peer.trip(now_ns);
    if (k % 2 == 0) trip.returned_ns += 300 * kMillis_ns;  // of this computer, or the way back
    clock.add(trip);
  }
  EXPECT_NEAR(error_ns(), before_ns, 30e3);
  EXPECT_EQ(clock.contradictions(), 0);
}

TEST_F(RoundTrips, AClockThatIsSetBeginsANewRelation) {
  run(20.0);
  peer.offset_ns += 30e6;
  now_ns += 125 * kMillis_ns;
  EXPECT_EQ(clock.add(peer.trip(now_ns)), Result::kContradiction);
  EXPECT_FALSE(clock.own_time(peer.time_at(now_ns), now_ns).has_value()) << "not while it is contradicted";
  run(3.0);
  EXPECT_EQ(clock.steps(), 1);
  EXPECT_LT(std::abs(error_ns()), 3.0 * sigma_ns());
}

TEST_F(RoundTrips, OneFalseAnswerIsNoStep) {
  run(20.0);
  RoundTrip trip = peer.trip(now_ns += 125 * kMillis_ns);
  trip.received_ns -= kSeconds_ns;
  trip.answered_ns -= kSeconds_ns;
  EXPECT_EQ(clock.add(trip), Result::kContradiction);
  run(0.2);
  EXPECT_EQ(clock.steps(), 0);
  EXPECT_LT(std::abs(error_ns()), 100e3);
}

TEST_F(RoundTrips, AreForgottenWhenTheyStayAway) {
  run(20.0);
  now_ns += RoundTripClock::kMaxAge_ns - kSeconds_ns;
  EXPECT_LT(std::abs(error_ns()), 2.0 * sigma_ns()) << "by the drift";
  now_ns += 2 * kSeconds_ns;
  EXPECT_FALSE(clock.own_time(peer.time_at(now_ns), now_ns).has_value());
}

TEST_F(RoundTrips, ImpossibleTimesAreRefused) {
  run(5.0);
  const RoundTrip good = peer.trip(now_ns);
  RoundTrip trip = good;
  trip.answered_ns = trip.received_ns - 1;
  EXPECT_EQ(clock.add(trip), Result::kImpossible);
  trip = good;
  trip.returned_ns = trip.asked_ns - 1;
  EXPECT_EQ(clock.add(trip), Result::kImpossible);
  trip = good;
  trip.received_ns = std::numeric_limits<std::int64_t>::min();
  EXPECT_EQ(clock.add(trip), Result::kImpossible);
  trip = good;
  trip.answered_ns = std::numeric_limits<std::int64_t>::max();
  EXPECT_EQ(clock.add(trip), Result::kImpossible);
  EXPECT_FALSE(clock.own_time(std::numeric_limits<std::int64_t>::max(), now_ns).has_value());
  EXPECT_FALSE(clock.own_time(std::numeric_limits<std::int64_t>::min(), now_ns).has_value());
  EXPECT_LT(std::abs(error_ns()), 200e3);
}

}  // namespace
}  // namespace pharos::host
