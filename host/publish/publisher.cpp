// SPDX-License-Identifier: Apache-2.0
#include "host/publish/publisher.hpp"

#include <utility>

#include "host/publish/messages.hpp"

namespace pharos::host {

Publisher::Publisher(MessageSink& sink, std::string prefix) : sink_(sink), prefix_(std::move(prefix)) {}

bool Publisher::send_buffer(const char* channel, bool encoded, std::int64_t& count) {
  channel_ = prefix_;
  channel_ += channel;
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

}  // namespace pharos::host
