// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <vector>

#include "host/vision/slam/bundle.hpp"
#include "host/vision/slam/keyframe_covariance.hpp"

namespace pharos::slam {

/// A target that turns at a constant rate about an axis that is fixed in the camera's frame, as a body without torque
/// about a principal axis before a camera that does not turn: R(t) = exp(rate (t - t_first)) R_first. Its translation
/// is not restricted. (Tweddle et al. 2015 adjust a spinning body with its equations of motion in general.)
struct SteadyRotation {
  Vector3 rate_rad_s = Vector3::Zero();  ///< in the rectified left camera's frame
  double first_s = 0.0;                  ///< of the first keyframe
  Matrix3 R_first = Matrix3::Identity();
  Vector3 middle_m = Vector3::Zero();  ///< of the points, in the target's frame
  double cost_increase = 0.0;          ///< of Huber's cost, over all observations, from the solution without it

  Matrix3 R_at(double time_s) const { return rotation_exp(rate_rad_s * (time_s - first_s)) * R_first; }
  /// The pose with the attitude of the time; the points' middle stays where it is in the camera's frame.
  CameraFromTarget steadied(const CameraFromTarget& pose, double time_s) const;
};

/// With fewer keyframes the hypothesis is not tried.
inline constexpr std::size_t kMinSteadyKeyframes = 10;
/// It is contradicted where an attitude of the adjustment without it is further off, in sigmas (max_deviation): stated
/// sigmas are up to three times too small (README). Of eleven random bodies that do turn so it was 2.2 to 4.6.
inline constexpr double kMaxSteadyDeviation = 6.0;
/// Or where its cost increases by more than so many times what is expected, a degree of freedom each and the
/// correlation factor of the covariances: 0.8 to 1.1 over four random bodies and a satellite that do turn so.
inline constexpr double kMaxSteadyCostRatio = 1.5;

using KeyframePoses = std::map<KeyframeId, CameraFromTarget>;

/// The first attitude turned by the mean of the steps from keyframe to keyframe, each below half a turn.
SteadyRotation mean_rotation(const KeyframePoses& poses, const std::map<KeyframeId, double>& times_s);

/// (12) with all attitudes on R(t), in place, as adjust_bundle: unknowns are the rate, the positions of all keyframes
/// but the first, and the points. `problem` is the solution without the hypothesis, `times_s` has every keyframe.
/// Huber's cost, then without observations that chi-squared rejects, then Geman's and McClure's: points that slide fit
/// free attitudes, which follow them, and do not fit these. Sets the numbers of the rejected observations.
SteadyRotation adjust_steady_rotation(BundleProblem& problem, const std::map<KeyframeId, double>& times_s,
                                      const StereoCamera& camera, int iterations, std::vector<std::size_t>& rejected);

/// Root of the largest chi-squared a degree of freedom of a keyframe's attitude in `steady`, relative to `free` and its
/// covariances. Infinite where an attitude has none.
double max_deviation(const KeyframePoses& free, const KeyframePoses& steady, const KeyframeCovariances& covariances);

/// zeta of T_free exp(zeta) = T_steady, as covariances of keyframes are.
Vector6 deviation_of(const CameraFromTarget& free, const CameraFromTarget& steady);

/// Adds the squares of the differences: if the hypothesis is wrong after all, the error is what it moved the poses by.
void add_deviations(const KeyframePoses& free, const KeyframePoses& steady, KeyframeCovariances& covariances);

}  // namespace pharos::slam
