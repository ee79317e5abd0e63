// SPDX-License-Identifier: Apache-2.0
// pharos tof: frames of a depth camera to poses of the docking ring (paper 000).
#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <memory>
#include <vector>

#include "host/cameras/camera_file.hpp"
#include "host/cameras/tof_target.hpp"
#include "host/device/frame_directory.hpp"
#include "host/support/input_error.hpp"
#include "pharos/tof/connector_pair.hpp"
#include "pharos/tof/tof_pose.hpp"
#include "tools/support/commands.hpp"
#include "tools/support/image_input.hpp"
#include "tools/support/output.hpp"
#include "tools/support/output_place.hpp"
#include "tools/support/progress.hpp"
#include "tools/tof/described_target.hpp"
#include "tools/tof/overlay.hpp"
#include "tools/tof/paper_frames.hpp"
#include "tools/tof/quantise.hpp"
#include "tools/tof/tof_rows.hpp"

namespace pharos::tools {
namespace {

constexpr const char* kExample =
    "Example:\n"
    "  pharos tof recording --camera camera.toml --overlay pictures > poses.csv\n"
    "The folder holds NNNN_intensity.png with NNNN_depth.png (16 bits), or the same as TIFF or PGM, or "
    "NNNN_abcy16.raw.\n"
    "  pharos tof recording --camera camera.toml --learn ring.toml; pharos tof other --camera camera.toml --target "
    "ring.toml\n"
    "  pharos tof recording --camera camera.toml --method paper --stages steps --summary\n"
    "Poses are T_camera_target: the ring's centre, and (8) of the paper for the angles. Without a connector (flag "
    "no_connector) gamma and the\n"
    "quaternion are empty and sigma_rot_deg is that of the two tilts. --summary prints mean and sigma as table 2.\n"
    "Where both connectors are seen, gamma comes from both: the angle between them is learnt from the frames before. "
    "Not with --window.\n"
    "--covariance: in the camera's frame; without a connector the variance about Z' is that of a uniform angle, pi^2/3 "
    "rad^2.\n"
    "--method paper: no sigma, no flags; 8-bit depth, one connector's middle, any region that passes its rules may be "
    "it.\n"
    "--format tum: time_s is the frame's number (of 16 digits and more: ns); frames without a turn have no line.";

struct Options {
  std::string folder;
  std::string camera;
  std::string overlay;
  std::string target;
  std::string learn;
  bool summary = false;
  int window = 1;
  int depth_bits = 16;
  tof::TofSettings settings;
  double min_diameter_mm = 0.0;
  double max_diameter_mm = 0.0;
  std::string method = "ring";
  std::string stages;
  std::string threshold = "printed";
  OutputOptions output;
};

// What became of one frame: a pose, or the word after refused_.
struct Outcome {
  std::optional<tof::TofPose> pose;
  std::string reason;
};

class Measurer {
 public:
  explicit Measurer(const Options& options)
      : options_(options),
        camera_(host::read_camera_file(options.camera).camera),
        frames_(options.folder),
        workspace_(std::make_unique<tof::TofWorkspace>()) {}

  std::size_t frames() const { return frames_.frames(); }
  const std::string& name(std::size_t index) const { return frames_.name(index); }
  const ImageInput& input() const { return input_; }

  Outcome measure(std::size_t index) {
    host::DepthFrame frame;
    try {
      input_.count_read(frames_.read(index, camera_.intrinsics.width_px, camera_.intrinsics.height_px, frame));
    } catch (const host::InputError& error) {
      input_.leave_out(error);
      return {std::nullopt, "unreadable"};
    }
    if (options_.depth_bits < 16) quantise_depth(frame.depth, options_.depth_bits);
    const tof::TofFrame view{frame.intensity_view(), frame.depth_view()};
    auto pose = tof::measure_tof_pose(view, camera_, options_.settings, *workspace_);
    // Not for means: errors of the angle between connectors are common to the frames.
    if (pose && options_.window == 1) pair_.refine(*pose);
    if (!options_.overlay.empty()) {
      const std::filesystem::path picture = std::filesystem::path(options_.overlay) / (name(index) + "_tof.png");
      write_overlay(picture.string(), view, camera_, pose, *workspace_);
    }
    if (!pose) return {std::nullopt, tof::name_of(pose.error())};
    return {*pose, ""};
  }

 private:
  const Options& options_;
  DepthCamera camera_;
  host::FrameDirectory frames_;
  ImageInput input_{"frame"};
  std::unique_ptr<tof::TofWorkspace> workspace_;
  tof::ConnectorPair pair_;
};

// Rows of single frames, or of windows of frames: a window's row is that of its last frame.
class Rows {
 public:
  Rows(const Options& options, host::RowWriter& rows) : options_(options), rows_(rows) {}

  void add(const std::string& frame, const Outcome& outcome, bool last) {
    if (outcome.pose) summary_.add(outcome.pose->target, outcome.pose->has_turn());
    if (options_.summary) return;
    if (options_.window == 1) {
      if (outcome.pose) {
        write_frame(rows_, frame, *outcome.pose);
      } else {
        write_refusal(rows_, frame, outcome.reason);
      }
      return;
    }
    if (outcome.pose && !outcome.pose->ambiguous()) window_.add(*outcome.pose);
    if (++in_window_ < options_.window && !last) return;
    if (window_.frames() > 0) {
      write_window(rows_, frame, window_);
    } else {
      write_refusal(rows_, frame, outcome.reason.empty() ? "ambiguous_window" : outcome.reason);
    }
    window_ = WindowMean();
    in_window_ = 0;
  }

  const PoseSummary& summary() const { return summary_; }

 private:
  const Options& options_;
  host::RowWriter& rows_;
  PoseSummary summary_;
  WindowMean window_;
  int in_window_ = 0;
};

void write_learnt(const std::string& path, const TargetLearner& learner) {
  if (learner.frames() == 0) {
    note("--learn: no frame shows ring and connectors; nothing was written to " + path);
    return;
  }
  std::ofstream out(path);
  if (!(out << host::docking_target_text(learner.learnt()) << std::flush)) {
    throw host::InputError(path + ": cannot be written; check the folder and the space left");
  }
  note("--learn: " + path + " from " + std::to_string(learner.frames()) + " frames");
}

int run_paper(const Options& options) {
  PaperFramesOptions paper{options.folder, options.camera};
  paper.stages = options.stages;
  paper.printed_threshold = options.threshold == "printed";
  paper.summary = options.summary;
  paper.output = options.output;
  return run_paper_frames(paper);
}

int run(Options options) {
  if (options.summary && (options.output.covariance || options.output.row_format() == host::RowFormat::kTum)) {
    throw host::InputError("--summary has no poses: give it without --covariance and --format tum");
  }
  if (options.method == "paper") return run_paper(options);
  if (options.min_diameter_mm > 0.0) options.settings.ring.min_outer_radius_m = 0.0005 * options.min_diameter_mm;
  if (options.max_diameter_mm > 0.0) options.settings.ring.max_outer_radius_m = 0.0005 * options.max_diameter_mm;
  if (!options.target.empty()) {
    host::apply_target(host::read_docking_target(options.target), options.target, options.settings);
  }
  if (!options.learn.empty()) require_writable(options.learn);
  TargetLearner learner;
  Measurer measurer(options);
  if (!options.overlay.empty()) {
    std::error_code error;
    std::filesystem::create_directories(options.overlay, error);
    if (error) throw host::InputError(options.overlay + ": cannot be made: " + error.message());
  }
  Output output(options.output, options.summary ? summary_columns() : tof_columns());
  Rows rows(options, output.rows());
  Progress progress("tof", "frames", measurer.frames());
  std::string reason;
  for (std::size_t k = 0; k < measurer.frames(); ++k) {
    const Outcome outcome = measurer.measure(k);
    if (!outcome.pose) reason = outcome.reason;
    if (outcome.pose && !options.learn.empty()) learner.add(*outcome.pose);
    rows.add(measurer.name(k), outcome, k + 1 == measurer.frames());
    progress.step();
  }
  if (options.summary && rows.summary().frames() > 0) write_summary(output.rows(), rows.summary());
  output.finish();
  const bool answered = rows.summary().frames() > 0;
  if (!options.learn.empty()) write_learnt(options.learn, learner);
  if (!answered) note(options.folder + ": no frame has a pose; the last one was refused_" + reason);
  return measurer.input().finish(answered);
}

void add_paper_options(CLI::App& command, Options& options) {
  command.add_option("--method", options.method, "ring: our estimator; paper: paper 000 as printed, on 8-bit depth")
      ->check(CLI::IsMember({"ring", "paper"}))
      ->capture_default_str();
  command.add_option("--stages", options.stages, "With --method paper: a folder for pictures of its steps")
      ->check(output_place());
  command
      .add_option("--threshold", options.threshold,
                  "With --method paper: (5) as printed (over the mean grey value), or with the count of pixels")
      ->check(CLI::IsMember({"printed", "count"}))
      ->capture_default_str();
}

// Each method has options of its own.
void refuse_options_of_the_other_method(const CLI::App& command, const Options& options) {
  const bool paper = options.method == "paper";
  const std::vector<const char*> ours = {"--overlay",          "--window",     "--depth-bits", "--least-diameter-mm",
                                         "--most-diameter-mm", "--connectors", "--target",     "--learn"};
  const std::vector<const char*> theirs = {"--stages", "--threshold"};
  for (const char* name : paper ? ours : theirs) {
    if (command.count(name) == 0) continue;
    throw host::InputError(std::string(name) + (paper ? " is not of --method paper" : " is of --method paper alone"));
  }
}

}  // namespace

void add_tof(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("tof", "Frames of a depth camera to poses of the docking ring");
  const auto options = std::make_shared<Options>();
  command->add_option("DIR", options->folder, "Folder of frames")->required();
  command->add_option("--camera", options->camera, "Camera file (TOML)")->required();
  command->add_flag("--summary", options->summary, "Mean and standard deviation of all frames, as the paper's table 2");
  command->add_option("--overlay", options->overlay, "Folder for pictures of what was found")->check(output_place());
  command->add_option("--window", options->window, "Mean of so many frames, with its covariance")
      ->check(CLI::Range(1, 100'000));
  command->add_option("--depth-bits", options->depth_bits, "Round depths to 2^N grey values first, as the paper (8)")
      ->check(CLI::Range(4, 16));
  command->add_option("--least-diameter-mm", options->min_diameter_mm, "No ring is smaller (default 500)")
      ->check(CLI::Range(50.0, 5000.0));
  command->add_option("--most-diameter-mm", options->max_diameter_mm, "No ring is larger (default 1500)")
      ->check(CLI::Range(50.0, 5000.0));
  command
      ->add_option("--connectors", options->settings.connector.expected,
                   "How many connectors the target carries (default 2); with fewer in sight gamma is not given")
      ->check(CLI::Range(1, 8));
  command->add_option("--target", options->target, "Target description (TOML): any one of its connectors gives gamma");
  command->add_option("--learn", options->learn, "Write a target description of ring and connectors, as seen");
  add_output_options(*command, options->output);
  add_pose_format_options(*command, options->output);
  add_paper_options(*command, *options);
  command->footer(kExample);
  command->callback([command, options, &exit_code] {
    refuse_options_of_the_other_method(*command, *options);
    exit_code = run(*options);
  });
}

}  // namespace pharos::tools
