// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "host/config/daemon_config.hpp"
#include "host/daemon/replay_speed.hpp"
#include "host/publish/health.hpp"
#include "host/publish/publisher.hpp"
#include "host/runtime/clock.hpp"
#include "host/runtime/event_loop.hpp"

namespace pharos::host {

/// Something in a source's care that cannot be written to the disk.
struct StorageError {
  const char* what = "";  // which of the daemon's log limits it falls under
  std::string text;       // one line for a person; empty when all is well
};

/// One sensor of the configuration in the daemon's loop. It watches its own descriptors, sends what it measures through
/// a PublishGate, and tells the daemon how it fares. All calls come from the loop's thread.
class Source {
 public:
  virtual ~Source() = default;
  /// As in the configuration.
  virtual const std::string& name() const = 0;
  /// Called ten times a second: opens what is not open, writes what is to be kept, logs what has changed.
  virtual void attend() = 0;
  /// SourceContext::config was read anew: takes over what can change while running (publish, calibrations of targets).
  virtual void reconfigure() {}
  /// Called once after the loop's end: writes what is still to be kept.
  virtual void stop() {}
  /// One for every system that measures with this sensor.
  virtual std::vector<SourceHealth> health() = 0;
  /// A recording that has come to its end and was answered to the last. The daemon stops when every source has; a
  /// source that becomes so calls SourceContext::on_finished.
  virtual bool finished() const { return false; }
  /// That this computer's clock was set a moment ago, as this source saw it, for people; empty when it was not.
  virtual std::string clock_notice() const { return {}; }
  virtual StorageError storage_error() const { return {}; }
  /// Counters of the daemon as a whole beside those in health().
  virtual NamedCounts daemon_counters() const { return {}; }
};

using SourceList = std::vector<std::unique_ptr<Source>>;

/// What the daemon lends to its sources; all of it outlives them.
struct SourceContext {
  EventLoop& loop;
  const Clock& clock;
  Publisher& publisher;
  const DaemonConfig& config;
  ReplaySpeed replay_speed = ReplaySpeed::kReal;
  std::function<void()> on_finished = [] {};
  /// A source calls it when something changed that nobody should wait a second for: the status goes out at once.
  std::function<void()> on_state_change = [] {};
};

/// A kind of source, as the daemon knows it.
struct SourceKind {
  /// One of them, in the log.
  const char* noun = "";
  /// Appends the sources of this kind that the configuration names, and returns how many these are. Throws InputError.
  std::function<std::size_t(const SourceContext&, SourceList&)> open;
};

using SourceKinds = std::vector<SourceKind>;

/// Every kind that pharosd has: the registration table.
const SourceKinds& source_kinds();

}  // namespace pharos::host
