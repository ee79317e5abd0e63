// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <lcm/lcm-cpp.hpp>
#include <string>

#include "tools/listen/message_shape.hpp"

namespace pharos::tools {

/// LCM's usual group, on this computer alone.
inline constexpr const char* kDefaultUrl = "udpm://239.255.76.67:7667?ttl=0";

/// `handler` receives the messages of all channels that the regular expression `channel` names, with `user`. Throws
/// host::InputError, with what to do, if LCM is not set up or the expression is none. At most `queue` messages wait to
/// be handled (LCM's own 30 if 0); further ones are dropped.
void subscribe(lcm::LCM& lcm, const std::string& url, const std::string& channel, lcm_msg_handler_t handler, void* user,
               int queue = 0);

/// Whether `data` is a message of this type, and whole; its fields then. Any bytes may come.
template <class Message>
bool decode(Message& message, const void* data, int size) {
  static_assert(!kMessageShape<Message>.empty(), "write the type's shape into message_shape.hpp");
  return has_shape(data, size, kMessageShape<Message>) && message.decode(data, 0, size) == size;
}

}  // namespace pharos::tools
