// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "pharos/geometry/pose_estimate.hpp"

namespace pharos::host {

/// Checks whether a pose can follow the previous ones of the same target. A frame that another sender inserted among a
/// camera's is measured like any other; it differs only by the position of its target.
///
/// Two poses are consistent if no point of the docking ring moved faster than kMaxSpeed_m_s between them, apart from
/// kSigmas of both. An inconsistent pose is refused. A target that has really moved (while hidden or lost) is accepted
/// after kConfirmations poses during kConfirmation_ns that are consistent with each other, with none between them that
/// is consistent with the last accepted one. Alternating frames of two senders therefore never confirm a jump. Nor does
/// anything for kContested_ns after frames of two senders came: the camera is then opened anew, its own frames may be
/// those that are lost, and five poses of half a second are the other sender's.
class PoseJumpCheck {
 public:
  /// A faster ring cannot be measured: the exposures of a depth frame take some 30 ms, in which its edges would move by
  /// 30 mm.
  static constexpr double kMaxSpeed_m_s = 1.0;
  /// The time of three frames. Longer gaps count as this: an attacker could cause a gap, and a gap does not mean that
  /// the target moved.
  static constexpr std::int64_t kMaxGap_ns = 100'000'000;
  /// Outer radius of the ring: the middle of the configuration's default range.
  static constexpr double kRadius_m = 0.5;
  static constexpr double kSigmas = 5.0;
  static constexpr int kConfirmations = 5;
  static constexpr std::int64_t kConfirmation_ns = 500'000'000;
  /// Ten times the confirmation, and longer than it takes to open a camera.
  static constexpr std::int64_t kContested_ns = 5'000'000'000;

  /// True if the pose may be reported. Poses must be in the order of their times; ambiguous poses must not be passed.
  template <class Parent, class Child>
  bool passes(const PoseEstimate<Parent, Child>& estimate, std::int64_t time_ns) {
    return passes(Sample{estimate.pose.R.col(2), estimate.pose.t, variance_of(estimate), time_ns});
  }

  /// How often frames of two senders have come until now.
  void on_contests(std::int64_t count, std::int64_t time_ns) {
    if (count > contests_) contested_until_ns_ = time_ns + kContested_ns;
    contests_ = count;
  }

 private:
  struct Sample {
    Vector3 axis;  // of the ring; the rotation about it is not always measured
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
  std::int64_t contests_ = 0;
  std::int64_t contested_until_ns_ = 0;
  int confirmations_ = 0;
};

/// The refusal of an inconsistent pose, and its advice.
inline constexpr const char* kJumpRefusal = "jump";
inline constexpr const char* kJumpAdvice =
    "the pose differs from the last ones by more than the target can have moved; frames of another sender, or a target "
    "that was replaced: taken when five poses of half a second agree";

}  // namespace pharos::host
