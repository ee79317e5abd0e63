// SPDX-License-Identifier: Apache-2.0
// pharos precision: expected precision of a target at given poses, before any measurement (002, section 3.3).
#include "pharos/pose/precision.hpp"

#include <CLI/CLI.hpp>
#include <variant>

#include "host/support/input_error.hpp"
#include "host/table/pose_table.hpp"
#include "host/table/target_file.hpp"
#include "pharos/base/units.hpp"
#include "tools/precision/noise_estimate.hpp"
#include "tools/support/commands.hpp"
#include "tools/support/output.hpp"
#include "tools/support/recording.hpp"
#include "tools/support/solver_options.hpp"
#include "tools/support/standard_input.hpp"
#include "tools/support/target_notes.hpp"

namespace pharos::tools {
namespace {

constexpr const char* kExample =
    "Example:\n"
    "  pharos precision --target target.csv --poses poses.csv --sigma-arcsec 8.8 --rho 0.8717\n"
    "poses.csv: pose,qw,qx,qy,qz,tx_m,ty_m,tz_m (T_lighthouse_body). A sensor is visible when its normal is within 60\n"
    "deg of the direction to the station; sensors without normals always are. The sigmas are equation (24).\n"
    "  pharos precision --estimate still.edges.csv.gz\n"
    "--estimate: sigma and rho of a recording in which nothing moves for at least 7 s, a row for each rotor: the "
    "noise\n"
    "of one raw angle, and the correlation between the sensors of a rotor, (19). A sensor whose\n"
    "sigma is twice or half the median sensor's is left out; a rotor whose angles wander, or whose sensors disagree, "
    "is\n"
    "refused.";

struct Options {
  std::string estimate;
  std::string target;
  std::string poses;
  NoiseOptions noise;
  OutputOptions output;
};

const std::vector<std::string> kColumns = {
    "pose", "visible", "adop_deg_per_rad", "pdop_m_per_rad", "sigma_rot_deg", "sigma_pos_mm", "status"};

bool write_row(const host::PoseRow& row, const Target& target, const NoiseOptions& noise, host::RowWriter& rows) {
  rows.text(row.key);
  if (!row.T_lighthouse_body) {
    rows.none(5).text("refused_no_pose").end_row();
    return false;
  }
  const pose::SensorSet visible = pose::visible_sensors(target, *row.T_lighthouse_body);
  rows.integer(static_cast<std::int64_t>(visible.count()));
  const auto precision = pose::precision_of(target, *row.T_lighthouse_body, visible, noise.rho);
  if (!precision) {
    rows.none(4).text(std::string("refused_") + pose::name_of(precision.error())).end_row();
    return false;
  }
  rows.number(precision->adop_deg_per_rad).number(precision->pdop_m_per_rad);
  rows.number(precision->adop_deg_per_rad * noise.sigma_rad());
  rows.number(precision->pdop_m_per_rad * noise.sigma_rad() * kMmPerM);
  rows.text("ok").end_row();
  return true;
}

int run(const Options& options) {
  require_one_standard_input({{"--target", options.target}, {"--poses", options.poses}});
  const host::TargetFile target = host::read_target(options.target);
  note_target_shape(options.target, target.shape);
  const std::vector<host::PoseRow> poses = host::read_poses(options.poses, "pose");
  Output output(options.output, kColumns);
  std::size_t answered = 0;
  for (const host::PoseRow& row : poses) {
    if (write_row(row, target.target, options.noise, output.rows())) ++answered;
  }
  output.finish();
  if (answered > 0) return kExitAnswered;
  note(options.poses + (poses.empty() ? ": no pose in the table" : ": no pose can be measured there; see status"));
  return kExitNoAnswer;
}

const std::vector<std::string> kNoiseColumns = {"station", "axis",  "sensors",  "turns", "sigma_arcsec",
                                                "rho",     "drift", "left_out", "status"};

const char* status_of(NoiseVerdict verdict) {
  switch (verdict) {
    case NoiseVerdict::kMoving:
      return "refused_moving";
    case NoiseVerdict::kDisagree:
      return "refused_sensors_disagree";
    case NoiseVerdict::kOk:
      break;
  }
  return "ok";
}

int run_estimate(const Options& options) {
  Recording recording(options.estimate);
  NoiseEstimator estimator;
  while (const auto event = recording.next()) {
    if (const auto* sweep = std::get_if<lighthouse::Sweep>(&*event)) estimator.push(*sweep);
  }
  const std::vector<RotorNoise> rotors = estimator.estimate();
  Output output(options.output, kNoiseColumns);
  bool answered = false;
  for (const RotorNoise& noise : rotors) {
    host::RowWriter& rows = output.rows();
    rows.integer(noise.station).text(noise.axis == Axis::kX ? "x" : "y").integer(noise.sensors).integer(noise.turns);
    const NoiseVerdict verdict = noise.verdict();
    if (verdict == NoiseVerdict::kOk) {
      answered = true;
      rows.number(noise.sigma_rad * kArcsecPerRad).number(noise.rho);
    } else {
      rows.none(2);
    }
    rows.number(noise.drift).integer(noise.left_out).text(status_of(verdict)).end_row();
  }
  output.finish();
  recording.print_remarks();
  if (answered) return kExitAnswered;
  note(options.estimate + (rotors.empty()
                               ? ": no sensor was hit for 6 s by any rotor; record longer"
                               : ": no rotor with sensors at rest that agree (see status); record a target at rest"));
  return kExitNoAnswer;
}

}  // namespace

void add_precision(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("precision", "Dilution of precision of a target at given poses");
  const auto options = std::make_shared<Options>();
  CLI::Option* target = command->add_option("--target", options->target, "Table sensor,x_m,y_m,z_m[,nx,ny,nz]");
  CLI::Option* poses =
      command->add_option("--poses", options->poses, "Table pose,qw,qx,qy,qz,tx_m,ty_m,tz_m; .gz; - is standard input");
  command
      ->add_option("--estimate", options->estimate,
                   "Instead: the noise of a RECORDING at rest, EDGES as of decode, or a serial stream")
      ->type_name("RECORDING")
      ->excludes(target)
      ->excludes(poses);
  add_noise_options(*command, options->noise);
  add_output_options(*command, options->output);
  command->footer(kExample);
  command->callback([options, &exit_code] {
    if (options->estimate.empty() && (options->target.empty() || options->poses.empty())) {
      throw host::InputError("give --target and --poses, or --estimate RECORDING (`pharos precision --help`)");
    }
    exit_code = options->estimate.empty() ? run(*options) : run_estimate(*options);
  });
}

}  // namespace pharos::tools
