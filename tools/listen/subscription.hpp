// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <lcm/lcm-cpp.hpp>
#include <string>

#include "host/receive/message_shape.hpp"

namespace pharos::tools {

/// LCM's usual group, on this computer alone.
inline constexpr const char* kDefaultUrl = "udpm://239.255.76.67:7667?ttl=0";

/// `handler` receives the messages of all channels that the regular expression `channel` names, with `user`. Throws
/// host::InputError, with what to do, if LCM is not set up or the expression is none. At most `queue` messages wait to
/// be handled (LCM's own 30 if 0); further ones are dropped.
void subscribe(lcm::LCM& lcm, const std::string& url, const std::string& channel, lcm_msg_handler_t handler, void* user,
               int queue = 0);

using host::decode;

}  // namespace pharos::tools
