// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/program_options.hpp"

#include <CLI/CLI.hpp>

namespace pharos::host {

void add_program_options(CLI::App& app, ProgramOptions& options) {
  app.description("Measures relative poses and broadcasts them over LCM");
  app.set_version_flag("--version", PHAROS_VERSION);
  app.add_option("config", options.config, "Configuration (TOML)")->required();
  app.add_flag("--check", options.check,
               "Only check the configuration and what it names, and print what was understood");
  app.add_option(
      "--replay", options.replay,
      "Play recordings instead of listening: a recorded serial stream, or a directory of recordings, in which "
      "every target, camera and rig finds its own; all keep step");
  app.add_flag("--fast", options.fast,
               "Play recordings as fast as they can be worked on, not at real speed; a subscriber on the network does "
               "not keep up and misses messages: keep them all with [lcm] url = \"file:///FILE?mode=w\"");
  app.footer(
      "Example: pharosd --check /etc/pharos/pharosd.toml\nEnds with 0 when stopped by a signal, with 1 when LCM "
      "cannot be set up, with 2 for a configuration that cannot be worked with.");
}

}  // namespace pharos::host
