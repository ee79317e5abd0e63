// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "host/daemon/event_loop.hpp"
#include "host/daemon/limited_log.hpp"
#include "host/daemon/line_feed.hpp"
#include "host/serial/reopening_port.hpp"

namespace pharos::host {

/// Bytes of a serial port that may be missing, busy or unplugged at any time and is tried again until it comes.
class PortFeed : public LineFeed {
 public:
  /// `loop` must outlive this. `name` is the target's, for the log.
  PortFeed(EventLoop& loop, std::string name, const std::string& path, int baud, LineFeedEvents events);
  ~PortFeed() override;

  void attend(std::int64_t monotonic_ns) override;
  SourceState state() const override;
  std::string trouble() const override;
  std::string device() const override { return port_.path(); }
  std::int64_t monotonic_now() const override;
  NamedCounts counters() const override;

 private:
  void on_readable();

  EventLoop& loop_;
  LimitedLog log_;
  ReopeningPort port_;
  LineFeedEvents events_;
  std::vector<std::uint8_t> buffer_;
  bool was_lost_ = false;
};

}  // namespace pharos::host
