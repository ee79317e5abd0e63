// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <spdlog/spdlog.h>

#include <cstdint>
#include <span>
#include <string>

#include "host/publish/message_sink.hpp"

namespace pharos::host {

/// Logs every message at level trace.
class TracedSink final : public MessageSink {
 public:
  /// `sink` must outlive this.
  explicit TracedSink(MessageSink& sink) : sink_(sink) {}

  bool send(const std::string& channel, std::span<const std::uint8_t> message) override {
    const bool sent = sink_.send(channel, message);
    spdlog::trace("{}: {} bytes{}", channel, message.size(), sent ? "" : ", not sent");
    return sent;
  }

 private:
  MessageSink& sink_;
};

}  // namespace pharos::host
