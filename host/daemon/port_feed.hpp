// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "host/daemon/byte_feed.hpp"
#include "host/daemon/rate_limited_log.hpp"
#include "host/runtime/clock.hpp"
#include "host/runtime/event_loop.hpp"
#include "host/serial/reopening_port.hpp"

namespace pharos::host {

/// Bytes of a serial port, which may be missing, busy or disconnected at any time and is then tried again.
class PortFeed : public ByteFeed {
 public:
  /// `loop` and `clock` must outlive this. `name` is the target's, for the log.
  PortFeed(EventLoop& loop, const Clock& clock, std::string name, const std::string& path, int baud,
           ByteFeedEvents events);
  ~PortFeed() override;

  void attend(std::int64_t monotonic_ns) override;
  SourceState state() const override;
  std::string error() const override;
  std::string device() const override { return port_.path(); }
  int baud() const override { return baud_; }
  std::int64_t monotonic_now() const override { return clock_.monotonic_ns(); }
  NamedCounts counters() const override;

 private:
  void on_readable();

  EventLoop& loop_;
  const Clock& clock_;
  RateLimitedLog log_;
  int baud_;
  ReopeningPort port_;
  ByteFeedEvents events_;
  std::vector<std::uint8_t> buffer_;
  bool was_lost_ = false;
};

}  // namespace pharos::host
