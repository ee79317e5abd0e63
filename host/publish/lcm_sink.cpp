// SPDX-License-Identifier: Apache-2.0
#include "host/publish/lcm_sink.hpp"

#include <lcm/lcm-cpp.hpp>

namespace pharos::host {

LcmSink::LcmSink(const std::string& url) : lcm_(std::make_unique<lcm::LCM>(url)) {
  if (lcm_->good()) return;
  throw LcmError("LCM cannot be set up with the URL \"" + url +
                 "\": check its spelling (udpm://239.255.76.67:7667?ttl=0), and that this computer has a route for "
                 "multicast (without a network: ip route add 224.0.0.0/4 dev lo)");
}

LcmSink::~LcmSink() = default;

bool LcmSink::send(const std::string& channel, std::span<const std::uint8_t> message) {
  return lcm_->publish(channel, message.data(), static_cast<unsigned>(message.size())) == 0;
}

}  // namespace pharos::host
