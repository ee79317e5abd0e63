// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "pharos/tof/connector_edges.hpp"
#include "pharos/tof/ring_model.hpp"

namespace pharos::tof {

struct TofPose;

/// A quantity that does not change from frame to frame, and its mean so far.
struct LearntValue {
  double mean = 0.0;
  double variance = 0.0;

  /// One more measurement: the mean weighted by inverse variances.
  void add(double value, double value_variance);
};

/// What a recording tells of the two connectors nearest to the ring's centre, so that both give the turn about Z'.
///
/// Without a target description X' is defined by the nearest one, and a frame by itself gives no more than that one's
/// direction. But the angle between the two, their distances and their heights are the body's, the same in every frame:
/// the second one's direction less the angle learnt from earlier frames is another measurement of the same turn, and
/// one that is farther from the centre gives it better. Learnt is nothing else: no pose is filtered, a frame's turn
/// comes from that frame's two directions, however the target moved since the last.
class ConnectorPair {
 public:
  /// Makes the turn of `pose`, its covariance and its connector's place those by both connectors, as far as earlier
  /// poses have told how these stand, and learns from it. A pose that is not one of two sure connectors, is ambiguous
  /// or is of a described target stays as it is; so does one whose pair disagrees with the learnt one by more than
  /// noise. Where several in a row disagree it is another body, and learning starts anew. About 1 us.
  void refine(TofPose& pose);

  /// Poses learnt from.
  std::int32_t frames() const { return frames_; }

 private:
  // One of both about the ring's centre, in a frame.
  struct Place {
    double angle_rad = 0.0, distance_m = 0.0;
    double variance_rad2 = 0.0, distance_variance_m2 = 0.0;  // by noise
    double common_rad2 = 0.0;                                // by what frames of one view share
    LearntValue height_m;
  };
  struct Learnt {
    LearntValue distance_m, height_m;
  };
  using Places = std::array<Place, 2>;

  static Place place_of(const RingModel& ring, const ConnectorFace& face);
  bool is_learnt_pair(const Places& places) const;
  void learn(const Places& places);
  // By both, in place of the first one `alone`.
  void turn_by(const Places& places, const Place& alone, TofPose& pose) const;

  std::array<Learnt, 2> learnt_;
  LearntValue between_rad_;  // from the first one's direction to the second one's
  std::int32_t frames_ = 0;
  std::int32_t disagreements_ = 0;
};

}  // namespace pharos::tof
