// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace pharos::host {

/// Where encoded messages go: LCM in the daemon, a list in tests.
class MessageSink {
 public:
  virtual ~MessageSink() = default;
  /// Sends one message at once; false where it could not be sent (the caller counts it).
  virtual bool send(const std::string& channel, std::span<const std::uint8_t> message) = 0;
};

}  // namespace pharos::host
