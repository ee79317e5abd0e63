// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "pharos/base/capacity.hpp"
#include "pharos/motion/doubtful_sweep.hpp"
#include "pharos/motion/station_relative.hpp"
#include "pharos/motion/station_track.hpp"

namespace pharos::motion {

/// Both stations' sweeps in one hypothesis, in the frame of slot 0's station, with where slot 1's stands as part of the
/// state.
///
/// It begins from slot 0's own track: at once where the stations' relative pose was measured, else when both tracks are
/// settled and determine it. It lives as long as either station sees the body. A doubtful sweep is judged by those that
/// follow it, as in a track of one station (DoubtfulSweep). Each station's own track continues in parallel: where the
/// two contradict each other for a quarter of a second the joint hypothesis is discarded, and with it the relative pose
/// if that is the cause.
class StationPair {
 public:
  using Tracks = std::array<const StationTrack*, kMaxStations>;

  /// The relative pose as measured; empty: to be learnt from what both stations see. The same again changes nothing: a
  /// measured one that was refused stays so, a learnt one stays.
  void survey(const std::optional<StationRelative>& relative);
  /// Takes a sweep that the station's own track has taken.
  void push(const lighthouse::SweepBearings& bearings, Axis axis, std::uint8_t station, const Tracks& tracks,
            const StationView& view, const AssumedNoise& noise);
  void lose();
  /// The calibration of a station changed: the relative pose estimated with the previous one is dropped.
  void forget_learnt();

  /// Null while there is none.
  const Hypothesis* joint() const { return joint_ ? &*joint_ : nullptr; }
  /// The other station's own track knows the pose better, and contradicts this one's by way of the relative pose
  /// that was measured: a learnt one may be what is wrong.
  bool contradicted(std::uint8_t station, const Tracks& tracks) const;
  /// Best estimate of the pose of slot 1's station; only while there is a joint hypothesis.
  std::optional<StationRelative> relative() const;
  /// The relative pose that was measured contradicts what both stations see, and is not used.
  bool survey_refused() const { return survey_refused_; }
  /// How often a relative pose, measured or estimated, was discarded.
  int refusals() const { return refusals_; }

 private:
  struct Known {
    StationFromStation T_1_0;
    Matrix6 covariance;

    bool operator==(const Known& other) const {
      return T_1_0.R == other.T_1_0.R && T_1_0.t == other.T_1_0.t && covariance == other.covariance;
    }
  };

  void take(const lighthouse::SweepBearings& bearings, Axis axis, Observer observer, const StationView& view,
            const AssumedNoise& noise);
  const Known* known() const;
  void start(const Tracks& tracks);
  void start_from_both(const Tracks& tracks);
  void remember();
  void watch(std::uint8_t station, const Tracks& tracks);
  double apart_square(const Known& known, const Tracks& tracks) const;

  std::optional<Hypothesis> joint_, without_;  // without a doubtful sweep, which joint_ has taken
  DoubtfulSweep doubt_;
  std::optional<Known> surveyed_, learnt_;
  bool survey_refused_ = false;
  int refusals_ = 0;
  std::array<int, kMaxStations> contradictions_{};
};

/// The state is kept in the frame of slot 0's station; slot 1's is the second.
constexpr Observer observer_of(std::uint8_t station) { return station == 0 ? Observer::kReference : Observer::kSecond; }

}  // namespace pharos::motion
