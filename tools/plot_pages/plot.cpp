// SPDX-License-Identifier: Apache-2.0
// pharos plot: pages of figures from the tables and files of the other commands.
#include <CLI/CLI.hpp>
#include <memory>

#include "host/support/input_error.hpp"
#include "host/table/target_file.hpp"
#include "tools/plot_pages/calibration_page.hpp"
#include "tools/plot_pages/pose_pages.hpp"
#include "tools/plot_pages/precision_page.hpp"
#include "tools/support/commands.hpp"
#include "tools/support/number_option.hpp"
#include "tools/support/output.hpp"
#include "tools/support/output_place.hpp"
#include "tools/support/solver_options.hpp"
#include "tools/support/standard_input.hpp"
#include "tools/support/target_notes.hpp"

namespace pharos::tools {
namespace {

constexpr const char* kExample =
    "Examples:\n"
    "  pharos plot poses poses.csv --truth mocap.csv --align hand-eye --output poses.html\n"
    "  pharos plot precision --target target.csv --max-range-m 8 --output precision.html\n"
    "  pharos plot calibration cal.toml --residuals residuals.csv --output cal.html\n"
    "  pharos plot calibration camera.toml --points points.csv --images images.csv --output camera.html\n"
    "Each writes one HTML file with its figures in it (SVG): no script, nothing from the network.";

struct PoseOptions {
  std::string poses, truth, align = "none", output;
  std::optional<int> station;
};

evaluate::TrajectoryFile<evaluate::EstimatePose> poses_of(const PoseOptions& options) {
  evaluate::TrajectoryChoice choice;
  choice.station = options.station;
  return evaluate::read_trajectory<evaluate::EstimatePose>(options.poses, choice);
}

evaluate::AlignMode align_mode(const std::string& word) {
  if (word == "se3") return evaluate::AlignMode::kSe3;
  return word == "hand-eye" ? evaluate::AlignMode::kHandEye : evaluate::AlignMode::kNone;
}

int plot_poses(const PoseOptions& options) {
  require_one_standard_input({{"POSES", options.poses}, {"--truth", options.truth}});
  require_writable(options.output);
  const auto poses = poses_of(options);
  if (poses.samples.empty()) {
    note(options.poses + ": no good pose in " + std::to_string(poses.rows) + " rows; nothing was drawn");
    return kExitNoAnswer;
  }
  HtmlPage page("Poses of " + options.poses);
  add_trajectory(page, options.poses, poses);
  bool compared = true;
  if (!options.truth.empty()) {
    const auto truth = evaluate::read_trajectory<evaluate::TruthPose>(options.truth, {});
    evaluate::ComparisonOptions comparison_options;
    comparison_options.mode = align_mode(options.align);
    const auto comparison = evaluate::compare(poses, truth, comparison_options);
    compared = comparison.refused.empty();
    if (compared) {
      add_errors(page, comparison);
    } else {
      note("not compared with " + options.truth + ": " + comparison.why);
      page.heading("Errors against the truth");
      page.paragraph("Not compared with " + options.truth + ": " + comparison.why);
    }
  }
  page.write(options.output);
  return compared ? kExitAnswered : kExitNoAnswer;
}

struct PrecisionOptions {
  std::string target, output;
  PrecisionVolume volume;
  NoiseOptions noise;
};

int plot_precision(const PrecisionOptions& options) {
  PrecisionVolume volume = options.volume;
  if (volume.max_range_m <= volume.min_range_m) {
    throw host::InputError("--max-range-m must be more than --min-range-m");
  }
  require_writable(options.output);
  const host::TargetFile target = host::read_target(options.target);
  note_target_shape(options.target, target.shape);
  volume.sigma_rad = options.noise.sigma_rad();
  volume.rho = options.noise.rho;
  HtmlPage page("Precision of " + options.target);
  page.paragraph("Noise of one bearing: " + shown_number(options.noise.sigma_arcsec) +
                 " arcsec, correlation within a " + "rotor " + shown_number(options.noise.rho) +
                 ". The target's z axis looks at the station's plane.");
  const int answered = add_precision(page, target.target, volume);
  if (answered == 0) {
    note(options.target + ": no pose can be measured anywhere in the volume; nothing was drawn");
    return kExitNoAnswer;
  }
  page.write(options.output);
  return kExitAnswered;
}

int plot_calibration(const CalibrationFiles& files, const std::string& output) {
  require_one_standard_input({{"CALIBRATION", files.calibration},
                              {"--residuals", files.residuals},
                              {"--images", files.images},
                              {"--points", files.points}});
  require_writable(output);
  HtmlPage page("Calibration " + files.calibration);
  add_calibration(page, files);
  page.write(output);
  return kExitAnswered;
}

void add_output(CLI::App& command, std::string& output) {
  command.add_option("-o,--output", output, "HTML file to write")->required()->check(output_place());
}

void add_plot_poses(CLI::App& plot, int& exit_code) {
  CLI::App* command = plot.add_subcommand("poses", "A trajectory, and its errors with three sigma");
  const auto options = std::make_shared<PoseOptions>();
  command->add_option("POSES", options->poses, "TUM, or a table with poses; .gz; - is standard input")->required();
  command->add_option("--truth", options->truth, "Truth in the same forms, or EuRoC's: errors are drawn too");
  command->add_option("--align", options->align, "Frames of POSES and truth: as for `pharos evaluate`")
      ->check(CLI::IsMember({"none", "se3", "hand-eye"}))
      ->capture_default_str();
  command->add_option("--station", options->station, "Rows of this station only");
  add_output(*command, options->output);
  command->footer(kExample);
  command->callback([options, &exit_code] { exit_code = plot_poses(*options); });
}

void add_plot_precision(CLI::App& plot, int& exit_code) {
  CLI::App* command = plot.add_subcommand("precision", "Expected sigmas of a target over a volume before a station");
  const auto options = std::make_shared<PrecisionOptions>();
  PrecisionVolume& volume = options->volume;
  command->add_option("--target", options->target, "Table sensor,x_m,y_m,z_m[,nx,ny,nz]")->required();
  command->add_option("--min-range-m", volume.min_range_m, "Nearest range")
      ->check(number_from(0.01, 1e4))
      ->capture_default_str();
  command->add_option("--max-range-m", volume.max_range_m, "Farthest range")
      ->check(number_from(0.01, 1e4))
      ->capture_default_str();
  command->add_option("--width-m", volume.width_m, "Width of the volume")
      ->check(number_from(0.01, 1e4))
      ->capture_default_str();
  command->add_option("--cells", volume.cells, "Cells along range and width")
      ->check(CLI::Range(2, 200))
      ->capture_default_str();
  add_noise_options(*command, options->noise);
  add_output(*command, options->output);
  command->footer(kExample);
  command->callback([options, &exit_code] { exit_code = plot_precision(*options); });
}

void add_plot_calibration(CLI::App& plot, int& exit_code) {
  CLI::App* command =
      plot.add_subcommand("calibration", "A calibration: coverage, residuals, covariance, what was refused");
  const auto files = std::make_shared<CalibrationFiles>();
  const auto output = std::make_shared<std::string>();
  command->add_option("CALIBRATION", files->calibration, "TOML file of `pharos calibrate`")->required();
  command->add_option("--residuals", files->residuals, "Table of `pharos calibrate lighthouse --residuals`");
  command->add_option("--images", files->images, "Table of `pharos calibrate camera --images`");
  command->add_option("--points", files->points, "Table of `pharos calibrate camera --points`: the field of residuals");
  add_output(*command, *output);
  command->footer(kExample);
  command->callback([files, output, &exit_code] { exit_code = plot_calibration(*files, *output); });
}

}  // namespace

void add_plot(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("plot", "Figures of trajectories, precision and calibrations as one page");
  command->require_subcommand(1);
  command->footer(kExample);
  add_plot_poses(*command, exit_code);
  add_plot_precision(*command, exit_code);
  add_plot_calibration(*command, exit_code);
}

}  // namespace pharos::tools
