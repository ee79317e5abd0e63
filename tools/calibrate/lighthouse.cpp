// SPDX-License-Identifier: Apache-2.0
// pharos calibrate lighthouse: recordings of a target stationary in many poses to sensor positions and rotor
// parameters.
#include <CLI/CLI.hpp>
#include <set>

#include "host/calibrate/calibration_file.hpp"
#include "host/calibrate/lighthouse_calibration.hpp"
#include "host/support/input_error.hpp"
#include "host/table/target_file.hpp"
#include "pharos/base/units.hpp"
#include "tools/calibrate/add_calibrate.hpp"
#include "tools/calibrate/length_option.hpp"
#include "tools/calibrate/reports.hpp"
#include "tools/calibrate/residual_picture.hpp"
#include "tools/calibrate/text_file.hpp"
#include "tools/support/calibration_file.hpp"
#include "tools/support/commands.hpp"
#include "tools/support/number_option.hpp"
#include "tools/support/output.hpp"
#include "tools/support/output_place.hpp"
#include "tools/support/picture_kind.hpp"
#include "tools/support/progress.hpp"
#include "tools/support/recording.hpp"
#include "tools/support/stations.hpp"
#include "tools/support/target_notes.hpp"
#include "tools/support/words.hpp"

namespace pharos::tools {
namespace {

constexpr const char* kExample =
    "Example:\n"
    "  pharos calibrate lighthouse rests.edges.csv.gz --target target.csv --length 4,8,0.1288,0.00002 --output "
    "cal.toml\n"
    "  pharos track flight.edges.csv.gz --target target.csv --calibration cal.toml > poses.csv\n"
    "Rest the target for two seconds in each of thirty poses, near and far, to the sides and tilted; at least six. On\n"
    "standard output: parameter,prior,value,prior_sigma,sigma,told (told: share of the variance that the recordings "
    "took\n"
    "away). Stations may not be moved between recordings of one calibration.";

struct Options {
  std::vector<std::string> edges;
  std::string target;
  std::string output;
  std::vector<std::string> lengths;
  std::string calibration = "ootx";
  std::string residuals;
  std::string picture;
  double sensor_sigma_mm = 0.4;
  int form = 1;
  bool json = false;
};

void check_files(const Options& options) {
  std::set<std::string> outputs;
  for (const std::string& path : {options.output, options.residuals, options.picture}) {
    if (path.empty()) continue;
    if (!outputs.insert(path).second) {
      throw host::InputError(path + ": two outputs in one file; give --output, --residuals and --picture their own");
    }
    require_writable(path);
  }
  std::size_t standard_inputs = options.target == "-" ? 1U : 0U;
  standard_inputs += options.calibration == "-" ? 1U : 0U;
  for (const std::string& path : options.edges) standard_inputs += path == "-" ? 1U : 0U;
  if (standard_inputs > 1)
    throw host::InputError("only one input can be standard input (-); give files for the others");
}

// Where a station restarts with other values during a recording, the recording is split in two.
void take(const lighthouse::OotxPayload& payload, Stations& stations, calibrate::RecordingLog& log) {
  if (!stations.push(payload)) return;
  const lighthouse::StationCalibration& now = *stations.calibration(payload.station);
  auto& before = log.station[payload.station];
  if (before && !(*before == now)) {
    throw host::InputError(log.name + ": station " + station_id_text(before->id) +
                           " changed its calibration or its place in the cycle within the recording; record anew");
  }
  before = now;
}

calibrate::RecordingLog read_log(const std::string& path, const std::optional<CalibrationFile>& file) {
  Recording recording(path);
  calibrate::RecordingLog log;
  log.name = recording.name();
  Stations stations;
  Progress progress("reading " + log.name, "sweeps and payloads");
  while (const std::optional<RecordingEvent> event = recording.next()) {
    if (const auto* payload = std::get_if<lighthouse::OotxPayload>(&*event)) take(*payload, stations, log);
    if (const auto* sweep = std::get_if<lighthouse::Sweep>(&*event)) log.push(*sweep);
    progress.step();
  }
  recording.print_remarks();
  if (!file) return log;
  for (std::uint8_t slot = 0; slot < kMaxStations; ++slot) {
    const lighthouse::StationCalibration* known = file->survey().find(slot, stations.id(slot));
    log.station[slot] = known != nullptr ? std::optional(*known) : std::nullopt;
  }
  return log;
}

calibrate::LighthouseCalibrationInput calibration_input(const Options& options) {
  calibrate::LighthouseCalibrationInput input;
  for (const std::string& length : options.lengths) input.lengths.push_back(parse_length(length));
  const host::TargetFile target = host::read_target(options.target);
  input.target = target.target;
  note_target_shape(options.target, target.shape);
  input.sigmas.sensor_position_m = options.sensor_sigma_mm / kMmPerM;
  input.form = options.form == 1 ? lighthouse::ModelForm::kForm1 : lighthouse::ModelForm::kForm2;
  std::optional<CalibrationFile> file;
  if (options.calibration != "ootx") file.emplace(options.calibration);
  for (const std::string& path : options.edges) input.recordings.push_back(read_log(path, file));
  return input;
}

int run(const Options& options) {
  check_files(options);
  calibrate::LighthouseCalibrationInput input = calibration_input(options);
  const Target nominal = input.target;
  const calibrate::LighthouseCalibration calibration = calibrate::calibrate_lighthouse(std::move(input));
  write_text_file(options.output, calibrate::calibration_text(calibration, nominal));
  if (options.output != "-") write_parameters(calibration, {options.json, "-"});
  if (!options.residuals.empty()) write_residuals(calibration, {options.json, options.residuals});
  if (!options.picture.empty()) write_residual_picture(calibration, options.picture);
  note_outcome(calibration);
  return kExitAnswered;
}

}  // namespace

void add_calibrate_lighthouse(CLI::App& calibrate, int& exit_code) {
  CLI::App* command = calibrate.add_subcommand(
      "lighthouse", "Sensor positions, rotors and stations from recordings of a target at rest in many poses");
  const auto options = std::make_shared<Options>();
  command
      ->add_option(
          "EDGES", options->edges,
          "Recordings, as `pharos track` takes them: tables sensor,rise_ticks,fall_ticks or serial streams; .gz")
      ->required();
  command->add_option("--target", options->target, "Table sensor,x_m,y_m,z_m[,nx,ny,nz]: the nominal positions")
      ->required();
  command->add_option("-o,--output", options->output, "Calibration file to write (TOML); - is standard output")
      ->check(output_place())
      ->required();
  command
      ->add_option(
          "--length", options->lengths,
          "SENSOR,SENSOR,METRES,SIGMA: a measured distance, which fixes the scale; may be given more than once")
      ->allow_extra_args(false);
  command
      ->add_option(
          "--calibration", options->calibration,
          "Where the stations' own values come from: ootx (what they send), or a TOML file of [[station]] tables")
      ->capture_default_str();
  command
      ->add_option("--sensor-sigma-mm", options->sensor_sigma_mm,
                   "How well the target was built: 1 sigma of each coordinate")
      ->check(number_from(1e-3, 100.0))
      ->capture_default_str();
  command
      ->add_option("--form", options->form, "Sign form of the station model's curve term; real stations fit 1 better")
      ->check(CLI::IsMember({1, 2}))
      ->capture_default_str();
  command->add_option("--residuals", options->residuals, "File for each sensor's and rotor's rms before and after")
      ->check(output_place());
  command->add_option("--picture", options->picture, "File for the same as a picture (SVG)")
      ->check(output_place())
      ->check(picture_kind(".svg"));
  command->add_flag("--json", options->json, "Tables as one JSON object a line instead of CSV");
  command->footer(kExample);
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace pharos::tools
