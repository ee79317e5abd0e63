// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "host/publish/message_sink.hpp"

namespace pharos::host {

/// Stores messages in place of LCM; refuses them while `broken`.
class MessageList : public MessageSink {
 public:
  struct Entry {
    std::string channel;
    std::vector<std::uint8_t> bytes;
  };

  bool send(const std::string& channel, std::span<const std::uint8_t> message) override {
    if (broken) return false;
    entries.push_back({channel, {message.begin(), message.end()}});
    return true;
  }

  /// Every message of `channel` that decodes as `Message`.
  template <class Message>
  std::vector<Message> all(const std::string& channel) const {
    std::vector<Message> messages;
    for (const Entry& entry : entries) {
      Message message;
      const int size = static_cast<int>(entry.bytes.size());
      if (entry.channel == channel && message.decode(entry.bytes.data(), 0, size) == size) messages.push_back(message);
    }
    return messages;
  }

  std::vector<Entry> entries;
  bool broken = false;
};

}  // namespace pharos::host
