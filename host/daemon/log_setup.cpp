// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/log_setup.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>
#include <syslog.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <mutex>
#include <string>
#include <utility>

#include "host/runtime/log_writer.hpp"
#include "host/support/input_error.hpp"
#include "host/support/unique_fd.hpp"

namespace pharos::host {
namespace {

constexpr const char* kName = "pharosd";
// Time for the last lines; leaves two thirds of a stop's second to everything else.
constexpr std::chrono::milliseconds kLastLines{300};
constexpr mode_t kFilePermissions = 0666;  // reduced by umask

int priority_of(spdlog::level::level_enum level) {
  switch (level) {
    case spdlog::level::trace:
    case spdlog::level::debug:
      return LOG_DEBUG;
    case spdlog::level::info:
      return LOG_INFO;
    case spdlog::level::warn:
      return LOG_WARNING;
    case spdlog::level::err:
      return LOG_ERR;
    default:
      return LOG_CRIT;
  }
}

bool write_line(int fd, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t written = ::write(fd, text.data() + done, text.size() - done);
    if (written >= 0) {
      done += static_cast<std::size_t>(written);
    } else if (errno == EAGAIN) {  // another process made it non-blocking
      pollfd writable{fd, POLLOUT, 0};
      ::poll(&writable, 1, -1);
    } else if (errno != EINTR) {
      return false;
    }
  }
  return true;
}

LogWriter::Write writer_of(const LogConfig& config) {
  if (config.sink == LogSink::kStandardError) {
    return [](const LogWriter::Line& line) { return write_line(STDERR_FILENO, line.text); };
  }
  if (config.sink == LogSink::kSyslog) {
    return [](const LogWriter::Line& line) {
      ::syslog(line.priority, "%s", line.text.c_str());
      return true;
    };
  }
  // O_NONBLOCK: opening a pipe without a reader fails at once instead of blocking the start.
  constexpr int kFlags = O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | O_NONBLOCK;
  const auto file = std::make_shared<UniqueFd>(::open(config.file.c_str(), kFlags, kFilePermissions));
  if (!file->valid()) {
    throw InputError(config.file.string() + ": cannot be opened for the log (" + std::strerror(errno) +
                     "); check [log] file and its folder's permissions");
  }
  return [file](const LogWriter::Line& line) { return write_line(file->get(), line.text); };
}

std::unique_ptr<spdlog::formatter> formatter_of(const LogConfig& config) {
  return std::make_unique<spdlog::pattern_formatter>(
      config.sink == LogSink::kSyslog ? "%v" : "%Y-%m-%dT%H:%M:%S.%e %l %v", spdlog::pattern_time_type::local,
      config.sink == LogSink::kSyslog ? "" : "\n");
}

LogWriter::Line formatted(spdlog::formatter& formatter, const spdlog::details::log_msg& message) {
  spdlog::memory_buf_t text;
  formatter.format(message, text);
  return {priority_of(message.level), fmt::to_string(text)};
}

LogWriter::Note note_of(const LogConfig& config) {
  const std::shared_ptr<spdlog::formatter> formatter = formatter_of(config);
  return [formatter](std::uint64_t dropped) {
    const std::string text = std::to_string(dropped) + " log lines were dropped: nobody took them in time";
    return formatted(*formatter, spdlog::details::log_msg(kName, spdlog::level::warn, text));
  };
}

}  // namespace

class DaemonLog::Sink final : public spdlog::sinks::base_sink<std::mutex> {
 public:
  explicit Sink(const LogConfig& config) : writer(writer_of(config), note_of(config)) {
    set_formatter_(formatter_of(config));
  }
  LogWriter writer;

 private:
  void sink_it_(const spdlog::details::log_msg& message) override { writer.push(formatted(*formatter_, message)); }
  void flush_() override {}
};

DaemonLog::DaemonLog(const LogConfig& config) : config_(config) {
  if (config.sink == LogSink::kSyslog) ::openlog(kName, 0, LOG_DAEMON);
  sink_ = std::make_shared<Sink>(config);
  spdlog::set_default_logger(std::make_shared<spdlog::logger>(kName, sink_));
  set_level(config);
}

DaemonLog::~DaemonLog() { sink_->writer.finish(kLastLines); }

void DaemonLog::set_level(const LogConfig& config) { spdlog::set_level(spdlog::level::from_str(config.level)); }

void DaemonLog::reopen() {
  if (config_.sink == LogSink::kFile) sink_->writer.set_write(writer_of(config_));
}

std::int64_t DaemonLog::lines_dropped() const { return static_cast<std::int64_t>(sink_->writer.dropped()); }

}  // namespace pharos::host
