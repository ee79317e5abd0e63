// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace pharos::frame {

// Tags that name coordinate frames in types, so that a product of poses whose inner frames differ does not compile.
// Each states its axes; every pose T_a_b takes coordinates in b to coordinates in a: p_a = R_a_b p_b + t_a_b.

/// L: lighthouse, x right, y down, z ahead of the station (the maker's frame of the station rotated by pi about x).
struct Lighthouse {};
/// B: the cooperative target's body, in which its sensor positions are given.
struct Body {};
/// C: camera, x right, y down, z forward (as in OpenCV).
struct Camera {};
/// R: a rig of two cameras, x right, y down, z ahead.
struct Rig {};
/// T: docking ring's target frame.
struct Target {};
/// A calibration board: x along its columns, y along its rows, z away from the camera.
struct Board {};
/// V: chase vehicle.
struct Vehicle {};
/// W: the room that several base stations stand in; where its origin and axes are is said by the file of the stations.
struct World {};

}  // namespace pharos::frame
