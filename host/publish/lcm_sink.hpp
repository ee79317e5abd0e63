// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <stdexcept>
#include <string>

#include "host/publish/message_sink.hpp"

namespace lcm {
class LCM;
}

namespace pharos::host {

/// Longest channel name of LCM.
inline constexpr std::size_t kMaxChannelLength = 63;

/// LCM cannot be set up; the message says what to do.
class LcmError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Sends over LCM. Sending is one sendto() by the calling thread; nothing waits for a subscriber.
class LcmSink : public MessageSink {
 public:
  /// Throws LcmError where LCM cannot be set up: a URL that it does not understand, or no route for multicast.
  explicit LcmSink(const std::string& url);
  ~LcmSink() override;

  bool send(const std::string& channel, std::span<const std::uint8_t> message) override;

 private:
  std::unique_ptr<lcm::LCM> lcm_;
};

}  // namespace pharos::host
