// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "host/config/daemon_config.hpp"

namespace pharos::host {

/// spdlog's default logger as the configuration asks for it, while this lives. Whoever logs never waits: see LogWriter.
class DaemonLog {
 public:
  /// Throws InputError when the log file cannot be opened.
  explicit DaemonLog(const LogConfig& config);
  DaemonLog(const DaemonLog&) = delete;
  DaemonLog& operator=(const DaemonLog&) = delete;
  /// What is logged may take a third of a second to leave; the rest is lost.
  ~DaemonLog();

  static void set_level(const LogConfig& config);
  /// Opens the log file anew, which may have been moved away. Throws InputError; the old one holds then.
  void reopen();
  /// Lines that nobody took.
  std::int64_t lines_dropped() const;

 private:
  class Sink;
  LogConfig config_;
  std::shared_ptr<Sink> sink_;
};

}  // namespace pharos::host
