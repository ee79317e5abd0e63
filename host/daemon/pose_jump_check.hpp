// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "pharos/geometry/pose_estimate.hpp"

namespace pharos::host {

/// Whether a pose can follow the last ones of the same target: a frame that somebody else put among a camera's is
/// measured as well as any other, and differs by where the target is.
///
/// Two poses fit each other where no point of the docking ring moved faster than kMaxSpeed_m_s between them, beside
/// kSigmas of both. One that does not fit is refused. A target that has really moved (it was hidden, or lost) is taken
/// when kConfirmations poses that fit each other say so for kConfirmation_ns with none between them that fits the last
/// one taken: frames of two senders in turns never confirm each other.
class PoseJumpCheck {
 public:
  /// Faster than this a ring cannot be measured: a depth frame is made of exposures over some 30 ms, during which its
  /// edges would move by 30 mm.
  static constexpr double kMaxSpeed_m_s = 1.0;
  /// Three frames' time. Over a longer gap no more than this counts: who keeps the camera's frames away makes the gap,
  /// and that nothing was seen does not mean that the target moved.
  static constexpr std::int64_t kMaxGap_ns = 100'000'000;
  /// From the ring's middle to its edge; of what the configuration takes as a ring by default, the middle.
  static constexpr double kRadius_m = 0.5;
  static constexpr double kSigmas = 5.0;
  static constexpr int kConfirmations = 5;
  static constexpr std::int64_t kConfirmation_ns = 500'000'000;

  /// True where the pose may be reported. Poses come in the order of their times; an ambiguous one is not for here.
  template <class Parent, class Child>
  bool passes(const PoseEstimate<Parent, Child>& estimate, std::int64_t time_ns) {
    return passes(Sample{estimate.pose.R.col(2), estimate.pose.t, variance_of(estimate), time_ns});
  }

 private:
  struct Sample {
    Vector3 axis;  // of the ring; the turn about it is not always measured
    Vector3 centre_m;
    double variance_m2 = 0.0;  // of a point on the ring's edge
    std::int64_t time_ns = 0;
  };

  template <class Parent, class Child>
  static double variance_of(const PoseEstimate<Parent, Child>& estimate) {
    const double rotation_rad = estimate.sigma_rotation_rad() * kRadius_m;
    const double position_m = estimate.sigma_position_m();
    return rotation_rad * rotation_rad + position_m * position_m;
  }
  bool passes(const Sample& sample);
  static bool fits(const Sample& before, const Sample& after);

  std::optional<Sample> last_;
  std::optional<Sample> candidate_;
  std::int64_t candidate_since_ns_ = 0;
  int confirmations_ = 0;
};

/// The refusal of such a pose, and its text.
inline constexpr const char* kJumpRefusal = "jump";
inline constexpr const char* kJumpAdvice =
    "the pose differs from the last ones by more than the target can have moved; frames of another sender, or a target "
    "that was replaced: taken when five poses of half a second agree";

}  // namespace pharos::host
