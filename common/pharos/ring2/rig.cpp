// SPDX-License-Identifier: Apache-2.0
#include "pharos/ring2/rig.hpp"

namespace pharos::ring2 {
namespace {

// No rig for metres is built closer, and a millimetre of baseline gives a depth of 3 m to half its size.
constexpr double kMinBaseline_m = 1e-3;
// Rounding error of a rotation that was read from text.
constexpr double kOrthonormal = 1e-6;

bool is_rotation(const Matrix3& R) {
  if (!R.allFinite()) return false;
  return (R.transpose() * R - Matrix3::Identity()).cwiseAbs().maxCoeff() < kOrthonormal && R.determinant() > 0.0;
}

}  // namespace

RigFault fault_of(const Rig& rig) {
  for (const RigView& view : rig.views) {
    if (!is_usable(view.intrinsics) || !view.T_rig_camera.t.allFinite()) return RigFault::kIntrinsics;
    if (!is_rotation(view.T_rig_camera.R)) return RigFault::kRotation;
  }
  const double baseline_m = (rig.views[1].T_rig_camera.t - rig.views[0].T_rig_camera.t).norm();
  return baseline_m < kMinBaseline_m ? RigFault::kCamerasCoincide : RigFault::kNone;
}

}  // namespace pharos::ring2
