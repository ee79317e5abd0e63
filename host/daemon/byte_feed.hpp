// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "host/daemon/arrival.hpp"
#include "host/publish/health.hpp"

namespace pharos::host {

/// Callbacks of a feed.
struct ByteFeedEvents {
  std::function<void(std::span<const std::uint8_t>, const Arrival&)> bytes;
  std::function<void()> lost;      // disconnected: the next bytes do not continue these
  std::function<void()> finished;  // a replay has ended
};

/// Source of a target's bytes: a port or a recording.
class ByteFeed {
 public:
  virtual ~ByteFeed() = default;
  /// Called several times a second by the loop's timer: opens the port if it is not open.
  virtual void attend(std::int64_t monotonic_ns) = 0;
  /// kOk, or the reason why no bytes can come; error() has the details.
  virtual SourceState state() const = 0;
  virtual std::string error() const = 0;
  virtual std::string device() const = 0;
  /// Speed of the serial line, 8N1.
  virtual int baud() const = 0;
  virtual bool finished() const { return false; }
  /// Current time on the clock of the arrivals.
  virtual std::int64_t monotonic_now() const = 0;
  virtual NamedCounts counters() const { return {}; }
};

}  // namespace pharos::host
