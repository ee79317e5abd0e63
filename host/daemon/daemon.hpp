// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "host/config/daemon_config.hpp"
#include "host/daemon/source.hpp"
#include "host/publish/publisher.hpp"
#include "host/runtime/event_loop.hpp"
#include "host/runtime/log_rate_limiter.hpp"
#include "host/runtime/signals.hpp"
#include "host/runtime/timer.hpp"

namespace pharos::host {

/// All sources of a configuration in one poll loop, and the status beside them.
class Daemon {
 public:
  /// Opens every source of every kind. Throws InputError for one that cannot be what the configuration says. `sink`,
  /// `signals` and `clock` must outlive this. `signals` end run().
  Daemon(const DaemonConfig& config, MessageSink& sink, Signals& signals, ReplaySpeed replay_speed, const Clock& clock,
         const SourceKinds& kinds = source_kinds());

  /// Until a signal comes, or every source was a recording and has come to its end.
  void run();

 private:
  void stop_when_all_finished();
  void attend();
  void on_signal();
  void publish_health();
  NamedCounts named_counts() const;
  std::string error() const;
  std::string sources_text() const;
  void warn(const char* kind, const std::string& text, std::int64_t now_ns);

  DaemonConfig config_;
  EventLoop loop_;
  Signals& signals_;
  const Clock& clock_;
  Timer attend_timer_;
  Timer status_timer_;
  Publisher publisher_;
  LogRateLimiter log_limit_;
  SourceContext context_;
  SourceList sources_;
  std::vector<std::pair<std::string, std::size_t>> counts_;  // of sources by kind
  std::int64_t started_ns_ = 0;
  std::int64_t last_logged_failed_ = 0;
  std::string message_;
};

}  // namespace pharos::host
