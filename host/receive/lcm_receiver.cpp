// SPDX-License-Identifier: Apache-2.0
#include "host/receive/lcm_receiver.hpp"

#include <lcm/lcm-cpp.hpp>
#include <utility>

#include "host/support/input_error.hpp"

namespace pharos::host {
namespace {

void call(const lcm_recv_buf_t* buffer, const char*, void* user) {
  const auto* data = static_cast<const std::uint8_t*>(buffer->data);
  (*static_cast<const MessageReceiver::Handler*>(user))({data, buffer->data_size});
}

}  // namespace

LcmReceiver::LcmReceiver(const std::string& url) : lcm_(std::make_unique<lcm::LCM>(url)) {
  if (lcm_->good() && lcm_->getFileno() >= 0) return;
  throw InputError("LCM cannot receive with the URL \"" + url +
                   "\": check its spelling (udpm://239.255.76.67:7667?ttl=1), and that this computer has a route for "
                   "multicast");
}

LcmReceiver::~LcmReceiver() = default;

void LcmReceiver::subscribe(const std::string& channel, Handler handler) {
  handlers_.push_back(std::move(handler));
  lcm_subscription_t* subscription = lcm_subscribe(lcm_->getUnderlyingLCM(), channel.c_str(), call, &handlers_.back());
  if (subscription == nullptr) throw InputError("LCM cannot receive the channel \"" + channel + '"');
  lcm_subscription_set_queue_capacity(subscription, kMaxWaiting);
}

int LcmReceiver::fd() const { return lcm_->getFileno(); }

void LcmReceiver::take() { lcm_->handleTimeout(0); }

}  // namespace pharos::host
