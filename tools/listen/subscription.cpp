// SPDX-License-Identifier: Apache-2.0
#include "tools/listen/subscription.hpp"

#include "host/support/input_error.hpp"

namespace pharos::tools {

// Uses LCM's C functions: those of C++ return a subscription also where it failed, and its owner would wait for ever.
// Receiving is set up first, with LCM's own test of multicast, so that the error message can distinguish the two
// failures.
void subscribe(lcm::LCM& lcm, const std::string& url, const std::string& channel, lcm_msg_handler_t handler, void* user,
               int queue) {
  if (!lcm.good() || lcm.getFileno() < 0) {
    if (url.rfind("file:", 0) == 0) {
      throw host::InputError("LCM cannot read --url " + url +
                             ": check that the file exists and is a recording of lcm-logger or pharosd with messages");
    }
    throw host::InputError("LCM cannot be set up with --url " + url +
                           ": check it, and that there is a route for multicast (without a network: "
                           "ip route add 224.0.0.0/4 dev lo)");
  }
  lcm_subscription_t* subscription = lcm_subscribe(lcm.getUnderlyingLCM(), channel.c_str(), handler, user);
  if (subscription == nullptr) {
    throw host::InputError("CHANNEL '" + channel +
                           "' is not a regular expression; mend it (PHAROS_.* hears all of them)");
  }
  if (queue > 0) lcm_subscription_set_queue_capacity(subscription, queue);
}

}  // namespace pharos::tools
