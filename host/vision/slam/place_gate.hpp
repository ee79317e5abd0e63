// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "host/vision/slam/map.hpp"

namespace pharos::slam {

/// Chi-squared with six degrees of freedom that one right place in a million exceeds: a refused loop costs drift, which
/// is stated; a false one costs the map.
inline constexpr double kPlaceChi2 = 38.26;

/// zeta of T_asked = T_expected exp(zeta), rotation (rad) before translation (m), about the target's axes: that of
/// keyframe_covariances. To second order in the rotation.
Vector6 place_offset(const CameraFromTarget& asked, const CameraFromTarget& expected);

/// Covariance of the keyframe's own coordinates (Pose::moved_by's delta) as one of zeta.
Matrix6 in_target_axes(const CameraFromTarget& pose, const Matrix6& covariance);

/// Covariance of zeta that one link of the graph adds: an error that all patches of `keyframe` have in common and that
/// the bundle does not model, a tenth of a pixel, the precision of an aligned patch.
///
/// A tenth of a pixel displaces the centre of the points that the keyframe observes by 0.1 D / f at the distance D, and
/// rotates about it by 0.1 D / (f r) with r the RMS distance of the points from their centre.
Matrix6 error_of_a_link(const Map& map, const Keyframe& keyframe, const StereoCamera& camera);

/// Covariance of zeta of `here` relative to `there` along the graph: those of both keyframes, as of the bundle, and for
/// each link of the spanning tree between them error_of_a_link().
Matrix6 drift_between(const Map& map, KeyframeId here, KeyframeId there, const StereoCamera& camera);

/// Number of links of the spanning tree between two keyframes.
int links_between(const Map& map, KeyframeId a, KeyframeId b);

/// Whether the squared Mahalanobis distance of `offset` exceeds kPlaceChi2; true where the covariance is not positive.
bool contradicts(const Vector6& offset, const Matrix6& covariance);

}  // namespace pharos::slam
