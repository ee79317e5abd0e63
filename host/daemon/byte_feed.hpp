// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "host/daemon/arrival.hpp"
#include "host/publish/health.hpp"

namespace pharos::host {

/// What a feed tells whoever works on its bytes.
struct ByteFeedEvents {
  std::function<void(std::span<const std::uint8_t>, const Arrival&)> bytes;
  std::function<void()> lost;      // unplugged: the next bytes are not the rest of these
  std::function<void()> finished;  // a replay has come to its end
};

/// Where a target's bytes come from: a port, or a recording.
class ByteFeed {
 public:
  virtual ~ByteFeed() = default;
  /// Called several times a second by the loop's timer: opens what is not open.
  virtual void attend(std::int64_t monotonic_ns) = 0;
  /// kOk, or what keeps bytes from coming and what to do.
  virtual SourceState state() const = 0;
  virtual std::string error() const = 0;
  virtual std::string device() const = 0;
  /// Speed of the wire that they came over, 8N1.
  virtual int baud() const = 0;
  virtual bool finished() const { return false; }
  /// The clock that its arrivals are on, now.
  virtual std::int64_t monotonic_now() const = 0;
  virtual NamedCounts counters() const { return {}; }
};

}  // namespace pharos::host
