// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/config/daemon_config.hpp"
#include "host/daemon/preview_stage.hpp"
#include "host/daemon/source.hpp"
#include "host/publish/publisher.hpp"
#include "host/runtime/event_loop.hpp"
#include "host/runtime/log_rate_limiter.hpp"
#include "host/runtime/signals.hpp"
#include "host/runtime/timer.hpp"

namespace pharos::host {

/// Callbacks into the program that runs the daemon. By default they do nothing.
struct DaemonControl {
  /// A signal to stop was received.
  std::function<void()> on_stop = [] {};
  /// Reads the configuration file again. Throws InputError.
  std::function<std::optional<DaemonConfig>()> reread = [] { return std::nullopt; };
  /// Sets the log's level and reopens its file. Throws InputError.
  std::function<void(const LogConfig&)> renew_log = [](const LogConfig&) {};
  /// Number of dropped log lines.
  std::function<std::int64_t()> log_lines_dropped = [] { return 0; };
};

/// All sources of a configuration in one event loop, and the status messages.
class Daemon {
 public:
  /// Opens every source of every kind. Throws InputError for a source that cannot be opened as configured. `sink`,
  /// `signals` and `clock` must outlive this. At SIGHUP the configuration is read again, twice a
  /// second at most; all other `signals` end run().
  Daemon(const DaemonConfig& config, MessageSink& sink, Signals& signals, ReplaySpeed replay_speed, const Clock& clock,
         const SourceKinds& kinds = source_kinds(), DaemonControl control = {});

  /// Runs until a signal to stop, or until all sources are recordings that have ended.
  void run();

 private:
  void stop_when_all_finished();
  void attend();
  void on_signal();
  void reread_config();
  void start_status_timer();
  void publish_health();
  NamedCounts named_counts() const;
  std::string error() const;
  std::string sources_text() const;
  void warn(const char* kind, const std::string& text, std::int64_t now_ns);

  DaemonConfig config_;
  DaemonControl control_;
  EventLoop loop_;
  Signals& signals_;
  const Clock& clock_;
  Timer reread_timer_;
  Timer attend_timer_;
  Timer status_timer_;
  Publisher publisher_;
  PreviewStage previews_;
  LogRateLimiter log_limit_;
  SourceContext context_;
  SourceList sources_;
  std::vector<std::pair<std::string, std::size_t>> counts_;  // of sources by kind
  std::int64_t started_ns_ = 0;
  std::int64_t last_logged_failed_ = 0;
  std::int64_t last_reread_ns_;
  bool reread_asked_ = false;
  std::string message_;
};

}  // namespace pharos::host
