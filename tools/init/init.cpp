// SPDX-License-Identifier: Apache-2.0
// pharos init: a first configuration of pharosd.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>

#include "host/config/load_config.hpp"
#include "host/files/atomic_file.hpp"
#include "host/gige/list_cameras.hpp"
#include "host/support/input_error.hpp"
#include "tools/devices/serial_survey.hpp"
#include "tools/init/first_config.hpp"
#include "tools/support/commands.hpp"
#include "tools/support/output.hpp"
#include "tools/support/output_place.hpp"

namespace pharos::tools {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds kListen{2500};

constexpr const char* kExample =
    "Examples:\n"
    "  pharos init --target-file target12.csv --output pharosd.toml     # boards that greet are found\n"
    "  pharos init --port /dev/ttyUSB0 --target-file target12.csv --output pharosd.toml\n"
    "  pharos init --camera-serial 233300001 --camera-file helios.toml --output pharosd.toml\n"
    "  pharos init --ask --output pharosd.toml                           # a question for each entry\n"
    "Without --port and --camera-... what `pharos devices` finds is taken. A board needs the file of its sensors'\n"
    "positions, a camera its camera file (`pharos calibrate camera`): what has none is named and left out. The result "
    "is\n"
    "checked as `pharosd --check` does before it is written; an existing file is kept unless --force is given.";

struct Options {
  std::string output;
  std::string target = "target", port, target_file;
  std::string camera = "camera", camera_serial, camera_address, camera_file;
  std::string state_directory;
  int baud = 460'800;
  bool ask = false, no_search = false, force = false;
};

// A line of standard input after a question on standard error; an empty line is `fallback`.
std::string answer(const std::string& question, const std::string& fallback) {
  std::fprintf(stderr, "%s%s: ", question.c_str(), fallback.empty() ? "" : (" [" + fallback + "]").c_str());
  std::string line;
  if (!std::getline(std::cin, line)) {
    std::fputc('\n', stderr);
    return fallback;
  }
  return line.empty() ? fallback : line;
}

// As a configuration's own relative paths start at its folder.
std::string absolute(const std::string& path) {
  return path.empty() ? "" : fs::absolute(path).lexically_normal().string();
}

struct Devices {
  std::vector<PortFinding> boards;
  std::vector<host::FoundCamera> cameras;
};

Devices search(const Options& options) {
  Devices devices;
  for (PortFinding& finding : survey_ports(serial_ports(), options.baud, kListen)) {
    if (finding.hello) {
      devices.boards.push_back(std::move(finding));
    } else {
      note(finding.port + ": no board greets: " + finding.message);
    }
  }
  devices.cameras = host::list_cameras();
  return devices;
}

FirstTarget target_of(const PortFinding& board, const Options& options) {
  FirstTarget target;
  target.name = config_name(std::string(board.hello->target.view()), options.target);
  target.port = board.port;
  target.baud = options.baud;
  target.target_file = options.target_file;
  target.serial = serial_of(*board.hello);
  target.sensors = sensors_of(*board.hello);
  return target;
}

// What the options name, and what was found where they name nothing.
FirstConfig proposed(const Options& options) {
  FirstConfig config;
  config.state_directory = absolute(options.state_directory);
  const bool named = !options.port.empty() || !options.camera_serial.empty() || !options.camera_address.empty();
  const Devices devices = named || options.no_search ? Devices{} : search(options);
  if (!options.port.empty()) {
    config.targets.push_back({options.target, options.port, options.target_file, options.baud, "", std::nullopt});
  }
  for (const PortFinding& board : devices.boards) config.targets.push_back(target_of(board, options));
  if (!options.camera_serial.empty() || !options.camera_address.empty()) {
    config.cameras.push_back(
        {options.camera, options.target, options.camera_file, options.camera_serial, options.camera_address});
  }
  for (const host::FoundCamera& camera : devices.cameras) {
    config.cameras.push_back({options.camera, options.target, options.camera_file, camera.serial, ""});
  }
  return config;
}

// Names are unique: the second `target` is target2.
template <class Sources>
void number_names(Sources& sources) {
  std::vector<std::string> taken;
  for (auto& source : sources) {
    std::string name = source.name;
    for (int k = 2; std::find(taken.begin(), taken.end(), name) != taken.end(); ++k) {
      name = source.name + std::to_string(k);
    }
    source.name = name;
    taken.push_back(name);
  }
}

void ask(FirstConfig& config, const Options& options) {
  if (config.targets.empty()) config.targets.push_back({options.target, "", options.target_file, options.baud, "", {}});
  for (FirstTarget& target : config.targets) {
    target.port = answer("Serial port of the target's board (- : none)", target.port.empty() ? "-" : target.port);
    if (target.port == "-") continue;
    target.name = answer("Name of the target", target.name);
    target.target_file = answer("File of its sensors' positions (sensor,x_m,y_m,z_m)", target.target_file);
  }
  std::erase_if(config.targets, [](const FirstTarget& target) { return target.port == "-"; });
  if (config.cameras.empty()) config.cameras.push_back({options.camera, options.target, options.camera_file, "", ""});
  for (FirstCamera& camera : config.cameras) {
    camera.serial = answer("Serial number of the depth camera (- : none)", camera.serial.empty() ? "-" : camera.serial);
    if (camera.serial == "-") continue;
    camera.name = answer("Name of the camera", camera.name);
    camera.target = answer("Name of what it observes", camera.target);
    camera.camera_file = answer("Its camera file (pharos calibrate camera)", camera.camera_file);
  }
  std::erase_if(config.cameras, [](const FirstCamera& camera) { return camera.serial == "-"; });
}

// Takes out what lacks its file, and says so.
void leave_out_incomplete(FirstConfig& config) {
  std::erase_if(config.targets, [](const FirstTarget& target) {
    if (!target.target_file.empty()) return false;
    note(target.port + ": left out: the file of its sensors' positions is missing; give --target-file");
    return true;
  });
  std::erase_if(config.cameras, [](const FirstCamera& camera) {
    if (!camera.camera_file.empty()) return false;
    note("camera " + (camera.serial.empty() ? camera.address : camera.serial) +
         ": left out: its camera file is missing; give --camera-file (pharos calibrate camera makes one)");
    return true;
  });
  for (FirstTarget& target : config.targets) target.target_file = absolute(target.target_file);
  for (FirstCamera& camera : config.cameras) camera.camera_file = absolute(camera.camera_file);
}

void note_written(const FirstConfig& config, const std::string& path) {
  for (const FirstTarget& target : config.targets) note("target " + target.name + " on " + target.port);
  for (const FirstCamera& camera : config.cameras) {
    note("camera " + camera.name + ", " + (camera.serial.empty() ? camera.address : camera.serial));
  }
  if (path != "-") note(path + " was written; start: pharosd " + path);
}

int run(const Options& options) {
  std::error_code ignored;
  if (options.output != "-" && fs::exists(options.output, ignored) && !options.force) {
    throw host::InputError(options.output + ": exists; give --force to write it anew, or another file");
  }
  FirstConfig config = proposed(options);
  if (options.ask) ask(config, options);
  leave_out_incomplete(config);
  if (config.empty()) {
    note("nothing to configure: name a port or a camera, or connect one (pharos devices shows what is found)");
    return kExitNoAnswer;
  }
  number_names(config.targets);
  number_names(config.cameras);
  const std::string text = config_text(config);
  const fs::path folder = options.output == "-" ? fs::current_path() : fs::absolute(options.output).parent_path();
  const auto checked = host::parse_daemon_config(text, options.output, folder, host::host_environment());
  for (const host::PlaceError& error : checked.place_errors) note(error.message);
  host::write_file(options.output, text);
  note_written(config, options.output);
  return kExitAnswered;
}

}  // namespace

void add_init(CLI::App& app, int& exit_code) {
  CLI::App* command =
      app.add_subcommand("init", "A first configuration of pharosd, from what is connected or answered");
  const auto options = std::make_shared<Options>();
  command->add_option("-o,--output", options->output, "Configuration to write; - is standard output")
      ->required()
      ->check(output_place());
  command->add_option("--port", options->port, "Serial port of a target's board");
  command->add_option("--target-file", options->target_file, "Its sensors' positions: sensor,x_m,y_m,z_m[,nx,ny,nz]");
  command->add_option("--target", options->target, "Name of the target")->capture_default_str();
  command->add_option("--baud", options->baud, "Speed of the ports")
      ->check(CLI::Range(300, 4'000'000))
      ->capture_default_str();
  command->add_option("--camera-serial", options->camera_serial, "Serial number of a depth camera");
  command->add_option("--camera-address", options->camera_address, "Its IP address");
  command->add_option("--camera-file", options->camera_file, "Its camera file (pharos calibrate camera)");
  command->add_option("--camera", options->camera, "Name of the camera")->capture_default_str();
  command->add_option("--state-directory", options->state_directory, "Where accepted calibrations are kept");
  command->add_flag("--ask", options->ask, "Ask on standard error for every entry; an empty line takes what is shown");
  command->add_flag("--no-search", options->no_search, "Do not look for boards and cameras");
  command->add_flag("--force", options->force, "Replace the file if it exists");
  command->footer(kExample);
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace pharos::tools
