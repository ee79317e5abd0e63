// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace pharos {
class bearings_t;
class clock_exchange_t;
class pointing_t;
class pose_t;
class preview_t;
class spin_t;
class status_t;
class target_state_t;
}  // namespace pharos

namespace pharos::host {

/// Whether the values are some that a pharosd sends: finite numbers, a quaternion of length one and variances that are
/// not negative where there is a pose, times and names within limits, sensors that exist. Whoever sends others is not
/// one; the caller leaves the message out and counts it. The type's header from proto/ is the caller's.
bool is_possible(const pose_t& message);
bool is_possible(const bearings_t& message);
bool is_possible(const pointing_t& message);
bool is_possible(const spin_t& message);
bool is_possible(const target_state_t& message);
bool is_possible(const status_t& message);
bool is_possible(const clock_exchange_t& message);
/// Also whether its bytes begin and end as a JPEG; they are not decoded.
bool is_possible(const preview_t& message);

}  // namespace pharos::host
