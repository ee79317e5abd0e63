// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "host/config/daemon_config.hpp"

namespace pharos::host {

/// Sets spdlog's default logger as configured, during the lifetime of this object. Logging never blocks: see LogWriter.
class DaemonLog {
 public:
  /// Throws InputError when the log file cannot be opened.
  explicit DaemonLog(const LogConfig& config);
  DaemonLog(const DaemonLog&) = delete;
  DaemonLog& operator=(const DaemonLog&) = delete;
  /// Writes the remaining lines for at most a third of a second; the rest is lost.
  ~DaemonLog();

  static void set_level(const LogConfig& config);
  /// Reopens the log file, which may have been moved away. Throws InputError, and keeps the old file then.
  void reopen();
  /// Number of lines that could not be written.
  std::int64_t lines_dropped() const;

 private:
  class Sink;
  LogConfig config_;
  std::shared_ptr<Sink> sink_;
};

}  // namespace pharos::host
