// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace pharos {
class bearings_t;
class pointing_t;
class pose_t;
class preview_t;
class spin_t;
class target_state_t;
}  // namespace pharos

namespace pharos::tools {

// Whether the values are some that a pharosd sends: finite numbers, a quaternion of length one where there is a pose,
// sensors that exist. Whoever sends others is not one; what they say is left out and counted.
bool is_possible(const pose_t& message);
bool is_possible(const bearings_t& message);
bool is_possible(const pointing_t& message);
bool is_possible(const spin_t& message);
bool is_possible(const target_state_t& message);
/// Also whether its bytes begin and end as a JPEG; they are not decoded.
bool is_possible(const preview_t& message);

}  // namespace pharos::tools
