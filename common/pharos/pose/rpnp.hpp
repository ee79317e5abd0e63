// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/pose/start_poses.hpp"

namespace pharos::pose {

/// RPnP (Li, Xu and Xie, "A Robust O(n) Solution to the Perspective-n-Point Problem", PAMI 2012), the start value that
/// the paper names beside DLT. Needs three rays.
///
/// Two sensors far apart span an axis; with each other sensor they make a triplet whose P3P constraint is a polynomial
/// of fourth degree in the one unknown that positions the axis. The minima of the sum of their squares (roots of a
/// polynomial of seventh degree) give up to four axes; the rotation about the axis and the translation then follow
/// linearly from all bearings.
StartPoses rpnp(const RaySet& set);

}  // namespace pharos::pose
