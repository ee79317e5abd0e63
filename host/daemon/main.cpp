// SPDX-License-Identifier: Apache-2.0
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "host/config/load_config.hpp"
#include "host/config/replay_config.hpp"
#include "host/daemon/daemon.hpp"
#include "host/daemon/log_setup.hpp"
#include "host/publish/lcm_sink.hpp"
#include "host/support/input_error.hpp"

namespace {

namespace host = pharos::host;

constexpr int kExitFailure = 1;
constexpr int kExitUsage = 2;

struct Options {
  std::string config;
  std::string replay;
  bool check = false;
  bool fast = false;
};

int run(const Options& options) {
  host::DaemonConfig config = host::load_daemon_config(options.config);
  const std::vector<std::string> errors = host::directory_errors(config);
  if (options.check) {
    std::fputs(host::describe(config).c_str(), stdout);
    for (const std::string& error : errors) {
      std::fprintf(stderr, "pharosd: %s: %s\n", options.config.c_str(), error.c_str());
    }
    return errors.empty() ? 0 : kExitUsage;
  }
  if (!options.replay.empty()) config = host::replay_config(config, options.replay);
  host::set_up_log(config.log);
  // Poses need neither directory: a disk that is read-only today is told, not a reason to stay down.
  for (const std::string& error : errors) spdlog::warn("{}", error);
  // A limit on file sizes then fails the write, as a full disk does, instead of ending the program.
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  host::Signals signals{SIGTERM, SIGINT, SIGHUP};
  host::LcmSink sink(config.lcm.url);
  const host::SystemClock clock;
  const auto speed = options.fast ? host::ReplaySpeed::kFastest : host::ReplaySpeed::kReal;
  host::Daemon daemon(config, sink, signals, speed, clock);
  daemon.run();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Measures relative poses and broadcasts them over LCM", "pharosd");
  Options options;
  app.set_version_flag("--version", PHAROS_VERSION);
  app.add_option("config", options.config, "Configuration (TOML)")->required();
  app.add_flag("--check", options.check,
               "Only check the configuration and what it names, and print what was understood");
  app.add_option("--replay", options.replay, "Play a recorded serial stream instead of listening to its target's port");
  app.add_flag("--fast", options.fast, "Play recordings as fast as they can be worked on, not at real speed");
  app.footer(
      "Example: pharosd --check /etc/pharos/pharosd.toml\nEnds with 0 when stopped by a signal, with 1 when LCM "
      "cannot be set up, with 2 for a configuration that cannot be worked with.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kExitUsage;
  }
  try {
    return run(options);
  } catch (const host::InputError& error) {
    std::fprintf(stderr, "pharosd: %s\n", error.what());
    return kExitUsage;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "pharosd: %s\n", error.what());
    return kExitFailure;
  }
}
