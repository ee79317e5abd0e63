// SPDX-License-Identifier: Apache-2.0
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <sstream>
#include <string>
#include <vector>

#include "host/config/load_config.hpp"
#include "host/config/replay_config.hpp"
#include "host/config/source_table.hpp"
#include "host/daemon/daemon.hpp"
#include "host/daemon/log_setup.hpp"
#include "host/daemon/program_options.hpp"
#include "host/daemon/traced_sink.hpp"
#include "host/publish/lcm_sink.hpp"
#include "host/runtime/signals.hpp"
#include "host/runtime/stop_deadline.hpp"
#include "host/support/input_error.hpp"

namespace {

namespace host = pharos::host;

constexpr int kExitFailure = 1;
constexpr int kExitUsage = 2;
// A stop may take one second; the rest of it is for the kernel to remove the process.
constexpr std::chrono::milliseconds kStopLimit{800};

using Options = host::ProgramOptions;

// Ignores signals that would end the program without need. A write beyond a limit on file sizes or into a closed pipe
// then fails with an error.
void ignore_signals() {
  for (const int signal : {SIGXFSZ, SIGPIPE, SIGUSR1, SIGUSR2, SIGALRM, SIGVTALRM, SIGPROF, SIGIO, SIGPWR}) {
    std::signal(signal, SIG_IGN);
  }
}

bool plays_recordings(const host::DaemonConfig& config) {
  return std::any_of(config.targets.begin(), config.targets.end(),
                     [](const auto& source) { return source.is_replay(); }) ||
         std::any_of(config.cameras.begin(), config.cameras.end(),
                     [](const auto& source) { return source.is_recorded(); }) ||
         std::any_of(config.stereos.begin(), config.stereos.end(),
                     [](const auto& source) { return source.is_recorded(); });
}

host::DaemonConfig load(const Options& options) {
  const host::DaemonConfig config = host::load_daemon_config(options.config);
  if (options.fast && options.replay.empty() && !plays_recordings(config)) {
    throw host::InputError("--fast is for recordings, and there is none; give --replay FILE");
  }
  return options.replay.empty() ? config : host::replay_config(config, options.replay);
}

int check(const Options& options) {
  const host::DaemonConfig config = load(options);
  std::fputs(host::describe(config).c_str(), stdout);
  for (const host::PlaceError& error : config.place_errors)
    std::fprintf(stderr, "pharosd: %s\n", error.message.c_str());
  return config.place_errors.empty() ? 0 : kExitUsage;
}

host::DaemonControl control_of(const Options& options, host::DaemonLog& log, host::StopDeadline& deadline) {
  host::DaemonControl control;
  control.on_stop = [&deadline] { deadline.begin(); };
  control.reread = [&options] { return load(options); };
  control.renew_log = [&log](const host::LogConfig& config) {
    host::DaemonLog::set_level(config);
    try {
      log.reopen();
    } catch (const host::InputError& error) {
      spdlog::warn("{}", error.what());  // the old file stays in use
    }
  };
  control.log_lines_dropped = [&log] { return log.lines_dropped(); };
  return control;
}

int run(const Options& options) {
  const host::DaemonConfig config = load(options);
  ignore_signals();
  host::Signals signals{SIGTERM, SIGINT, SIGHUP};
  host::StopDeadline deadline({SIGTERM, SIGINT}, kStopLimit);
  host::DaemonLog log(config.log);
  // Poses need neither directory: a read-only disk is reported but does not prevent the start.
  for (const host::PlaceError& error : config.place_errors) spdlog::warn("{}", error.message);
  for (const std::string& line : host::source_table(config)) spdlog::info("{}", line);
  host::LcmSink lcm(config.lcm.url);
  host::TracedSink sink(lcm);
  const host::SystemClock clock;
  const auto speed = options.fast ? host::ReplaySpeed::kFastest : host::ReplaySpeed::kReal;
  host::Daemon daemon(config, sink, signals, speed, clock, host::source_kinds(), control_of(options, log, deadline));
  daemon.run();
  deadline.set_exit_code(0);  // everything was published and stored
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("", "pharosd");
  Options options;
  host::add_program_options(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kExitUsage;
  }
  try {
    return options.check ? check(options) : run(options);
  } catch (const host::InputError& error) {
    std::istringstream lines(error.what());
    for (std::string line; std::getline(lines, line);) std::fprintf(stderr, "pharosd: %s\n", line.c_str());
    return kExitUsage;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "pharosd: %s\n", error.what());
    return kExitFailure;
  }
}
