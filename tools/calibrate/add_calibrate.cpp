// SPDX-License-Identifier: Apache-2.0
#include "tools/calibrate/add_calibrate.hpp"

#include <CLI/CLI.hpp>

#include "tools/support/commands.hpp"

namespace pharos::tools {

void add_calibrate(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("calibrate", "Recordings or images to a calibration file");
  command->require_subcommand(1);
  command->footer(
      "Example:\n  pharos calibrate lighthouse rests.edges.csv.gz --target target.csv --output calibrated.toml\n"
      "  pharos calibrate stations sweeps.csv --target target.csv --output stations.toml\n"
      "  pharos calibrate mounting lighthouse.csv tof.csv --given lighthouse --output mounting.toml\n"
      "  pharos calibrate camera board*.png --board dots --output camera.toml");
  add_calibrate_lighthouse(*command, exit_code);
  add_calibrate_stations(*command, exit_code);
  add_calibrate_camera(*command, exit_code);
  add_calibrate_stereo(*command, exit_code);
  add_calibrate_mounting(*command, exit_code);
}

}  // namespace pharos::tools
