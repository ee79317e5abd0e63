// SPDX-License-Identifier: Apache-2.0
#include "host/publish/publisher.hpp"

#include <utility>

#include "host/publish/messages.hpp"
#include "pharos/clock_exchange_t.hpp"
#include "pharos/preview_t.hpp"

namespace pharos::host {

Publisher::Publisher(MessageSink& sink, std::string prefix) : sink_(sink), prefix_(std::move(prefix)) {}

bool Publisher::send_buffer(bool encoded, std::int64_t& count) {
  if (!encoded || !sink_.send(channel_, buffer_)) {
    ++counters_.failed;
    return false;
  }
  counters_.bytes += static_cast<std::int64_t>(buffer_.size());
  ++count;
  return true;
}

bool Publisher::publish_health(const DaemonHealth& health) {
  return send("STATUS", status_message(health, status_sequence_++));
}

bool Publisher::publish_clock(const std::string& channel, const clock_exchange_t& message) {
  channel_ = channel;
  return send_buffer(encode(message), counters_.clock);
}

bool Publisher::publish_preview(const preview_t& message) { return send("PREVIEW", message); }

}  // namespace pharos::host
