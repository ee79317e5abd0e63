// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace pharos::host {

/// Where messages of other programs come from: LCM in the daemon, a list in tests.
class MessageReceiver {
 public:
  /// The bytes are valid during the call only, and may be anything.
  using Handler = std::function<void(std::span<const std::uint8_t> message)>;

  virtual ~MessageReceiver() = default;
  /// All messages of this channel from now on.
  virtual void subscribe(const std::string& channel, Handler handler) = 0;
  /// Readable while a message waits; -1: none ever does, handlers are called otherwise.
  virtual int fd() const = 0;
  /// Calls the handler of one message that waits; returns at once without one.
  virtual void take() = 0;
};

}  // namespace pharos::host
