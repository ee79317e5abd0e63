// SPDX-License-Identifier: Apache-2.0
// pharos calibrate mounting: tables of poses of one moving target to where its sources are mounted.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>

#include "host/calibrate/mounting/mounting_calibration.hpp"
#include "host/mounting/mounting_file.hpp"
#include "host/support/input_error.hpp"
#include "pharos/base/units.hpp"
#include "tools/calibrate/add_calibrate.hpp"
#include "tools/calibrate/mounting_report.hpp"
#include "tools/calibrate/text_file.hpp"
#include "tools/support/commands.hpp"
#include "tools/support/number_option.hpp"
#include "tools/support/output_place.hpp"

namespace pharos::tools {
namespace {

constexpr const char* kMountingExample =
    "Example:\n"
    "  pharos calibrate mounting lighthouse.csv tof.csv ring2.csv slam=camera.csv --given lighthouse \\\n"
    "    --output mounting.toml --report mounting.html\n"
    "Move and turn the target for a minute where all sources see it: 15 deg and more about two axes. A table is that "
    "of\n"
    "pharos track, tof, circles or slam --format csv; NAME=FILE names a source, otherwise the file's name does, and\n"
    "NAME:KIND=FILE says its kind where the name is none (lighthouse, tof, ring2, slam). tof and ring2 need a column\n"
    "time_s, or --rate. Errors that last longer than a recording (--slow-deg, --slow-mm) are in the sigmas.\n"
    "Slam's T_target_feature holds for its recording alone: the next start has another one, and fuse does not use it.\n"
    "On standard output: source,parameter,value,sigma; residuals and what is not observable on standard error.";

constexpr std::size_t kMaxRows = 200'000;  // of one table: an hour and a half at 30 Hz

// Slam's drift in rotation acts with the lever arm to its own origin, the camera at the first image.
constexpr double kSlamSlow_mm = 1.5;

struct MountingOptions {
  std::vector<std::string> tables;
  std::string given, prior, output, report, rig;
  double rate_hz = 0.0, slow_deg = 0.02, slow_mm = 0.4, max_offset_s = 0.5, knot_s = 0.4;
  bool json = false;
};

struct TablePlace {
  std::string name, file;
  host::SourceKind kind = host::SourceKind::kLighthouse;
};

TablePlace place_of(const std::string& argument) {
  TablePlace place;
  const std::size_t equals = argument.find('=');
  place.file = equals == std::string::npos ? argument : argument.substr(equals + 1);
  place.name =
      equals == std::string::npos ? std::filesystem::path(place.file).filename().string() : argument.substr(0, equals);
  if (equals == std::string::npos) place.name = place.name.substr(0, place.name.find('.'));
  const std::size_t colon = place.name.find(':');
  const std::string word = colon == std::string::npos ? place.name : place.name.substr(colon + 1);
  place.name = place.name.substr(0, colon);
  const auto kind = host::source_kind(word);
  if (!kind) {
    throw host::InputError(argument + ": what kind of source is \"" + word +
                           "\"? give NAME:KIND=FILE with lighthouse, tof, ring2 or slam");
  }
  place.kind = *kind;
  return place;
}

calibrate::MountingRecording read_recording(const TablePlace& place, const MountingOptions& options) {
  host::SourceTableChoice choice;
  if (options.rate_hz > 0.0) choice.rate_hz = options.rate_hz;
  host::SourceTable table(place.file, place.kind, choice);
  calibrate::MountingRecording recording;
  recording.name = place.name;
  recording.kind = place.kind;
  recording.slow_rotation_rad = options.slow_deg * kRadPerDeg;
  const bool slam = place.kind == host::SourceKind::kSlam;
  recording.slow_position_m = (slam ? std::max(options.slow_mm, kSlamSlow_mm) : options.slow_mm) / kMmPerM;
  while (const auto row = table.next()) {
    if (recording.rows.size() == kMaxRows)
      throw host::InputError(table.name() + ": more than 200,000 poses; give a minute");
    recording.rows.push_back(*row);
  }
  return recording;
}

calibrate::MountingCalibrationInput read_input(const MountingOptions& options) {
  calibrate::MountingCalibrationInput input;
  input.given = options.tables.size();
  for (const std::string& argument : options.tables) {
    const TablePlace place = place_of(argument);
    for (const calibrate::MountingRecording& other : input.recordings) {
      if (other.name == place.name) throw host::InputError("source \"" + place.name + "\" comes twice; give NAME=FILE");
    }
    if (place.name == options.given) input.given = input.recordings.size();
    input.recordings.push_back(read_recording(place, options));
  }
  if (input.given == options.tables.size()) {
    throw host::InputError("--given " + options.given + ": no table has this name");
  }
  if (!options.prior.empty()) input.prior = host::read_mounting_file(options.prior);
  input.max_offset_s = options.max_offset_s;
  input.knot_spacing_s = options.knot_s;
  return input;
}

int run_mounting(const MountingOptions& options) {
  require_writable(options.output);
  const calibrate::MountingCalibrationInput input = read_input(options);
  calibrate::MountingCalibration calibration = calibrate::calibrate_mounting(input);
  calibration.mounting.rig = input.prior && options.rig.empty() ? input.prior->rig : options.rig;
  write_text_file(options.output, host::mounting_text(calibration.mounting));
  if (!options.report.empty()) write_mounting_report(calibration, options.report);
  if (options.output != "-") write_mounting_parameters(calibration, {options.json, "-"});
  note_mounting(calibration);
  return kExitAnswered;
}

}  // namespace

void add_calibrate_mounting(CLI::App& calibrate, int& exit_code) {
  CLI::App* command = calibrate.add_subcommand(
      "mounting", "Where sources are mounted on the vehicle, their features on the target, and their delays");
  const auto options = std::make_shared<MountingOptions>();
  command->add_option("TABLE", options->tables, "Table of poses of one source: FILE, NAME=FILE or NAME:KIND=FILE; .gz")
      ->required();
  command->add_option("--given", options->given, "Source whose mounting and feature define vehicle and target frame")
      ->required();
  command->add_option("--prior", options->prior,
                      "What is known before (mounting.toml): the given source's mounting, and what stays of directions "
                      "that the recording does not tell");
  command->add_option("-o,--output", options->output, "File to write (TOML); - is standard output")
      ->check(output_place())
      ->required();
  command->add_option("--report", options->report, "HTML page with the residuals over time")->check(output_place());
  command->add_option("--rig", options->rig, "Name of the vehicle or bench, written into the file");
  command->add_option("--rate", options->rate_hz, "Hz, of tables whose rows count frames")
      ->check(number_from(1e-3, 1e4));
  command->add_option("--slow-deg", options->slow_deg, "1 sigma of slow errors of each source, each axis")
      ->check(number_from(1e-6, 10.0))
      ->capture_default_str();
  command->add_option("--slow-mm", options->slow_mm, "The same of positions")
      ->check(number_from(1e-6, 1e3))
      ->capture_default_str();
  command->add_option("--max-offset-s", options->max_offset_s, "Time offsets are searched within this")
      ->check(number_from(1e-3, 5.0))
      ->capture_default_str();
  command->add_option("--knots-s", options->knot_s, "Spacing of the knots of the target's motion")
      ->check(number_from(0.02, 5.0))
      ->capture_default_str();
  command->add_flag("--json", options->json, "The table as one JSON object a line instead of CSV");
  command->footer(kMountingExample);
  command->callback([options, &exit_code] { exit_code = run_mounting(*options); });
}

}  // namespace pharos::tools
