// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "pharos/network/station.hpp"

namespace pharos::convert {

/// T_world_station of a pose of libsurvive, whose stations look along -Z with Y up.
network::WorldFromStation station_pose(const Quaternion& q, const Vector3& t);

/// Reads libsurvive's configuration file, the `.json` beside a record: objects `lighthouseN` with mode (the channel),
/// id, pose (x, y, z, then quaternion w, x, y, z of the station, which looks along -Z with Y up, in the world),
/// PositionSet and the fields fcal*. It is not JSON (no outer braces, commas missing), but its values are.
/// Lighthouse 2.0 only.
///
/// Throws InputError of one line.
network::Stations read_libsurvive_config(const std::string& text, const std::string& name);

}  // namespace pharos::convert
