// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/log_setup.hpp"

#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/sinks/syslog_sink.h>
#include <spdlog/spdlog.h>

#include <memory>

#include "host/support/input_error.hpp"

namespace pharos::host {
namespace {

constexpr const char* kName = "pharosd";

// The loop is one thread: sinks need no lock.
spdlog::sink_ptr make_sink(const LogConfig& config) {
  switch (config.sink) {
    case LogSink::kStandardError:
      return std::make_shared<spdlog::sinks::stderr_sink_st>();
    case LogSink::kSyslog:
      return std::make_shared<spdlog::sinks::syslog_sink_st>(kName, 0, LOG_DAEMON, false);
    case LogSink::kFile:
      break;
  }
  try {
    return std::make_shared<spdlog::sinks::basic_file_sink_st>(config.file.string());
  } catch (const spdlog::spdlog_ex& error) {
    throw InputError(config.file.string() + ": cannot be opened for the log (" + error.what() +
                     "); check [log] file and its folder's permissions");
  }
}

}  // namespace

void set_up_log(const LogConfig& config) {
  auto logger = std::make_shared<spdlog::logger>(kName, make_sink(config));
  logger->set_level(spdlog::level::from_str(config.level));
  logger->set_pattern(config.sink == LogSink::kSyslog ? "%v" : "%Y-%m-%dT%H:%M:%S.%e %l %v");
  logger->flush_on(spdlog::level::info);
  spdlog::set_default_logger(std::move(logger));
}

}  // namespace pharos::host
