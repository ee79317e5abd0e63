// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <memory>
#include <string>

#include "host/receive/message_receiver.hpp"

namespace lcm {
class LCM;
}

namespace pharos::host {

/// Receives over LCM. A thread of LCM reads the network; handlers run in the thread that calls take().
///
/// At most kMaxWaiting messages of a channel wait to be taken, further ones are dropped by LCM.
class LcmReceiver final : public MessageReceiver {
 public:
  /// Throws InputError where LCM cannot receive with this URL (no route for multicast, a file that is written).
  explicit LcmReceiver(const std::string& url);
  ~LcmReceiver() override;

  /// Of `channel` as it is: letters, digits and `_` alone, as LCM takes it for a regular expression.
  void subscribe(const std::string& channel, Handler handler) override;
  int fd() const override;
  void take() override;

  static constexpr int kMaxWaiting = 100;

 private:
  std::unique_ptr<lcm::LCM> lcm_;
  std::deque<Handler> handlers_;  // LCM holds their addresses
};

}  // namespace pharos::host
