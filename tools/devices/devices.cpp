// SPDX-License-Identifier: Apache-2.0
// pharos devices: what is connected to this computer.
#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>

#include "host/gige/list_cameras.hpp"
#include "tools/devices/serial_survey.hpp"
#include "tools/support/commands.hpp"
#include "tools/support/number_option.hpp"
#include "tools/support/output.hpp"

namespace pharos::tools {
namespace {

constexpr const char* kExample =
    "Example:\n"
    "  pharos devices\n"
    "  pharos devices /dev/ttyS4 --no-cameras --seconds 5\n"
    "Rows: serial ports (pharos-*, serial/by-id/*, ttyUSB*, ttyACM* in /dev, or those that are named) with the board "
    "that\n"
    "greets there, and GigE Vision cameras. status: ok, or of a port: no_hello, unknown_data, silent, busy (pharosd "
    "or\n"
    "another program has it), no_permission, missing, bad_speed, error. Nothing is written to any port. It takes the "
    "time "
    "of\n"
    "--seconds at most, and one second for cameras. Ends with 0 if a board or a camera was found, with 1 if none was.";

struct Options {
  std::vector<std::string> ports;
  int baud = 460'800;
  double seconds = 2.5;
  bool no_cameras = false;
  OutputOptions output;
};

const std::vector<std::string> kColumns = {"kind",     "address", "status", "model",  "serial",
                                           "firmware", "sensors", "target", "message"};

void write_port(const PortFinding& finding, host::RowWriter& rows) {
  rows.text("serial").text(finding.port).text(finding.status);
  if (finding.hello) {
    const wire::Hello& hello = *finding.hello;
    rows.text(hello.board.view()).text(serial_of(hello)).text(version_of(hello)).integer(sensors_of(hello));
    rows.text(hello.target.view());
  } else {
    rows.none(5);
  }
  rows.text(finding.message).end_row();
}

void write_camera(const host::FoundCamera& camera, host::RowWriter& rows) {
  rows.text("camera").text(camera.address).text("ok").text(camera.vendor + ' ' + camera.model).text(camera.serial);
  rows.none(4).end_row();
}

int run(const Options& options) {
  Output output(options.output, kColumns);
  const std::chrono::milliseconds limit(std::lround(1e3 * options.seconds));
  bool found = false;
  for (const PortFinding& finding :
       survey_ports(options.ports.empty() ? serial_ports() : options.ports, options.baud, limit)) {
    write_port(finding, output.rows());
    found = found || finding.hello.has_value();
  }
  if (!options.no_cameras) {
    for (const host::FoundCamera& camera : host::list_cameras()) {
      write_camera(camera, output.rows());
      found = true;
    }
  }
  const bool any = output.rows().rows() > 0;
  output.finish();
  if (!any) note("no serial port and no camera: is one connected, and may this user see it?");
  return found ? kExitAnswered : kExitNoAnswer;
}

}  // namespace

void add_devices(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("devices", "Serial ports with the boards that greet there, GigE cameras");
  const auto options = std::make_shared<Options>();
  command->add_option("PORTS", options->ports, "Ports to listen to instead of all adaptors");
  command->add_option("--baud", options->baud, "Speed of the ports")
      ->check(CLI::Range(300, 4'000'000))
      ->capture_default_str();
  command->add_option("--seconds", options->seconds, "How long to listen at most; boards greet once a second")
      ->check(number_from(0.1, 60.0))
      ->capture_default_str();
  command->add_flag("--no-cameras", options->no_cameras, "Do not search for cameras");
  add_output_options(*command, options->output);
  command->footer(kExample);
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace pharos::tools
