// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "host/config/daemon_config.hpp"
#include "host/daemon/preview_stage.hpp"
#include "host/publish/health.hpp"
#include "host/publish/publisher.hpp"
#include "host/receive/lcm_receiver.hpp"
#include "host/runtime/clock.hpp"
#include "host/runtime/event_loop.hpp"
#include "host/runtime/replay_timeline.hpp"

namespace pharos::host {

/// An error of a source that cannot write its data to the disk.
struct StorageError {
  const char* what = "";  // kind of message for the daemon's log limit
  std::string text;       // one readable line; empty without an error
};

/// One sensor of the configuration in the daemon's event loop. It watches its own descriptors, publishes its
/// measurements through a PublishGate, and reports its health to the daemon. All calls come from the loop's thread.
class Source {
 public:
  virtual ~Source() = default;
  /// Its name in the configuration.
  virtual const std::string& name() const = 0;
  /// Called ten times a second: opens what is not open, writes data to be stored, logs changes.
  virtual void attend() = 0;
  /// SourceContext::config was read again: takes over the settings that can change while running (publish, calibrations
  /// of targets).
  virtual void reconfigure() {}
  /// Called once after the loop's end: writes remaining data.
  virtual void stop() {}
  /// The health of every system that measures with this sensor.
  virtual std::vector<SourceHealth> health() = 0;
  /// True for a recording that has ended and is processed completely. The source then calls SourceContext::on_finished;
  /// the daemon stops when all sources have finished.
  virtual bool finished() const { return false; }
  /// Readable notice that this computer's clock was recently set, as detected by this source; empty otherwise.
  virtual std::string clock_notice() const { return {}; }
  virtual StorageError storage_error() const { return {}; }
  /// Counters for the daemon as a whole, in addition to those in health().
  virtual NamedCounts daemon_counters() const { return {}; }
};

using SourceList = std::vector<std::unique_ptr<Source>>;

/// The daemon's services for its sources; they outlive all sources.
struct SourceContext {
  EventLoop& loop;
  const Clock& clock;
  Publisher& publisher;
  const DaemonConfig& config;
  ReplaySpeed replay_speed = ReplaySpeed::kReal;
  std::function<void()> on_finished = [] {};
  /// To be called for a change that must be reported without delay: publishes the status at once.
  std::function<void()> on_state_change = [] {};
  /// How messages of other programs are received; throws InputError.
  std::function<std::unique_ptr<MessageReceiver>(const std::string& url)> open_receiver = [](const std::string& url) {
    return std::make_unique<LcmReceiver>(url);
  };
  /// Of all recordings that are played, so that they keep step.
  std::shared_ptr<ReplayTimeline> replay = std::make_shared<ReplayTimeline>(clock, replay_speed);
  /// Pictures of cameras for people; null: nobody takes them.
  PreviewStage* previews = nullptr;

  bool preview_due(const std::string& source) const { return previews != nullptr && previews->due(source); }
};

/// A kind of source.
struct SourceRegistration {
  /// Its name in the log, singular.
  const char* noun = "";
  /// Appends the configured sources of this kind and returns their number. Throws InputError.
  std::function<std::size_t(const SourceContext&, SourceList&)> open;
};

using SourceKinds = std::vector<SourceRegistration>;

/// The registration table: all kinds of source of pharosd.
const SourceKinds& source_kinds();

}  // namespace pharos::host
