// SPDX-License-Identifier: Apache-2.0
// pharos slam: stereo pairs to the poses of a target without a model (paper 004).
#include <CLI/CLI.hpp>
#include <chrono>
#include <memory>
#include <optional>

#include "host/cameras/pair_order.hpp"
#include "host/cameras/rig_file.hpp"
#include "host/support/input_error.hpp"
#include "host/vision/enhance/eight_bits.hpp"
#include "host/vision/slam/slam_system.hpp"
#include "tools/slam/pair_files.hpp"
#include "tools/slam/pose_files.hpp"
#include "tools/slam/slam_files.hpp"
#include "tools/support/commands.hpp"
#include "tools/support/image_input.hpp"
#include "tools/support/output.hpp"
#include "tools/support/output_place.hpp"
#include "tools/support/progress.hpp"

namespace pharos::tools {
namespace {

constexpr const char* kExample =
    "Example:\n"
    "  pharos slam left right --rig rig.toml --report report.json --map map.ply > poses.tum\n"
    "Rows: timestamp tx ty tz qx qy qz qw, metres: the pose of the target in the left camera's frame, relative to its\n"
    "pose at the first frame (T_C_T with T = C then); --output camera gives its inverse. A frame that is lost has no\n"
    "row, in a table (--format csv, --json) no pose: time_s,qw,qx,qy,qz,tx_m,ty_m,tz_m,sigma_rot_deg,sigma_pos_mm,\n"
    "status; --covariance: in the left camera's frame, of its inverse with --output camera; nothing of it holds the "
    "first\n"
    "pose, which is exact. --scene auto says on standard error which scene it is: target where the background is dark "
    "all around,\n"
    "else static: nothing is masked, the camera moves; --output camera tells its path.\n"
    "--rotation auto says so too where it takes a target's rotation as steady; sigmas are then those without it, and\n"
    "what it moves.\n"
    "Images: PNG, TIFF, PGM or PPM of 8 or 16 bits (of which the upper 8 count, unless enhanced), JPEG or BMP; of "
    "colour\n"
    "the luma. One without partner, a pair that cannot be read or is of another size is told, counted and left out.\n"
    "--overlay: DIR/NAME_slam.png, green: of the map, yellow: with depth, red: without; what is masked is blue.";

struct Options {
  PairChoice names;
  std::string rig;
  std::string scene = "auto", output = "target", rotation = "auto";
  OutputOptions poses;
  std::string report, map, overlay;
  bool no_loops = false, threads = false;
  std::string enhance;  // empty, or the denoiser
  slam::SlamSettings settings;
};

std::optional<enhance::EnhanceSettings> enhance_settings(const std::string& denoiser) {
  if (denoiser.empty()) return std::nullopt;
  enhance::EnhanceSettings settings;
  if (denoiser == "bm3d-video") settings.bm3d = enhance::kVideoBm3d;
  if (denoiser == "fast") settings.denoiser = enhance::Denoiser::kFast;
  if (denoiser == "none") settings.denoiser = enhance::Denoiser::kNone;
  return settings;
}

// Pushes pairs and reports their outcome.
class Feeder {
 public:
  Feeder(const Options& options, const host::RigFile& rig, slam::SlamSystem& system)
      : options_(options), rig_(rig), system_(system), lit_(enhance_settings(options.enhance)) {}

  /// Pairs that cannot be read, or are of another size than the first one, are reported and left out. A first pair of
  /// another size than the rig's cameras is an error, because all others would be too.
  void feed(const host::PairName& pair, RunFigures& figures) {
    const std::optional<PairImages> images = fitting_pair(pair);
    figures.unreadable = static_cast<int>(input_.left_out());
    if (!images) return;
    const auto start = std::chrono::steady_clock::now();
    const auto ms = [&start] {
      return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    };
    const auto [left, right] = lit_.both(images->left.view(), images->right.view());
    figures.light_ms.push_back(ms());
    const slam::TrackedFrame frame = system_.push(pair.time_s, left, right);
    figures.to_pose_ms.push_back(ms());
    if (frame.lost && !lost_) note(pair.left + ": tracking is lost; looking for known views");
    lost_ = frame.lost;
    if (frame.placed && !scene_told_) tell_scene();
    if (frame.relocalised) note(pair.left + ": found again");
    if (!options_.overlay.empty()) write_slam_overlay(options_.overlay, pair.stem, system_);
  }
  const ImageInput& input() const { return input_; }

 private:
  void tell_scene() {
    scene_told_ = true;
    if (options_.settings.scene != slam::Scene::kAuto) return;
    note(system_.report().scene == slam::Scene::kStatic
             ? "scene: static (something is seen all around: nothing is masked)"
             : "scene: target (the background is dark all around: it is masked)");
  }
  std::optional<PairImages> fitting_pair(const host::PairName& pair) {
    bool read = false;
    try {
      PairImages images = read_pair(pair);
      read = true;
      require_size(pair, images, rig_);
      require_two_views(pair, images);
      input_.count_read(images.left.from_colour ? pair.left : images.right.from_colour ? pair.right : "");
      any_ = true;
      return images;
    } catch (const host::InputError& error) {
      if (read && !any_) throw;
      input_.leave_out(error);
      return std::nullopt;
    }
  }

  const Options& options_;
  const host::RigFile& rig_;
  slam::SlamSystem& system_;
  enhance::EightBitPairs lit_;
  ImageInput input_{"pair"};
  bool any_ = false, lost_ = false, scene_told_ = false;
};

int run(Options options) {
  require_place_for_covariance(options.poses);
  options.settings.scene = slam::scene_named(options.scene);
  options.settings.close_loops = !options.no_loops;
  options.settings.steady_rotation = options.rotation == "auto";
  options.settings.threads = options.threads;
  for (const std::string& file : {options.report, options.map, options.poses.path}) {
    if (!file.empty()) require_writable(file);
  }
  RunFigures figures;
  const std::vector<host::PairName> pairs = wanted_pairs(options.names, figures);
  const host::RigFile rig = host::read_rig_file(options.rig);
  const auto system = slam::make_slam(rig, options.rig, options.settings);
  Feeder feeder(options, rig, *system);
  Progress progress("slam", "pairs", pairs.size());
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    feeder.feed(pairs[k], figures);
    progress.step();
    note_quarter(k + 1, pairs.size(), figures);
  }
  system->finish();
  const std::vector<slam::TrackedFrame> trajectory = system->trajectory();
  if (system->report().steady_rotation) {
    note("rotation: steady (nothing contradicts a constant rate about a fixed axis; --rotation free is without it)");
  }
  const int rows = write_poses({options.poses, options.output == "camera"}, trajectory);
  if (!options.map.empty()) write_map_ply(options.map, system->points());
  if (!options.report.empty()) write_slam_report(options.report, *system, figures);
  if (rows == 0 && !feeder.input().nothing_read()) {
    note(options.names.left + ": no frame could be placed: " + std::to_string(system->report().frames) +
         " pairs, none with enough stereo features");
  }
  return feeder.input().finish(rows > 0);
}

int run_or_refuse(const Options& options) try { return run(options); } catch (const host::NoPairError& error) {
  note(error.what());
  return kExitNoAnswer;
}

}  // namespace

void add_slam(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("slam", "Stereo pairs to the poses of a target without a model");
  const auto options = std::make_shared<Options>();
  command->add_option("LEFT", options->names.left, "Folder of left images, raw or rectified, in order of their names")
      ->required();
  command->add_option("RIGHT", options->names.right, "Folder of right images")->required();
  command->add_option("--rig", options->rig, "Rig file (TOML)")->required();
  command
      ->add_option(
          "--scene", options->scene,
          "auto (default): as the pictures show; target: a body before dark or stillness; static: all of the image")
      ->check(CLI::IsMember({"auto", "target", "static"}));
  command
      ->add_option("--rotation", options->rotation,
                   "Of a target: auto (default): at a constant rate about a fixed axis where nothing contradicts it; "
                   "free: any")
      ->check(CLI::IsMember({"auto", "free"}));
  command
      ->add_option("--output", options->output,
                   "Poses of the target in the camera (default), or of the camera in the scene")
      ->check(CLI::IsMember({"target", "camera"}));
  command->add_option("-o", options->poses.path, "File for the poses instead of standard output (-)")
      ->type_name("FILE")
      ->check(output_place());
  options->poses.format = "tum";
  add_pose_format_options(*command, options->poses);
  command->add_flag("--json", options->poses.json, "One JSON object a line with the names of --format csv");
  command->add_option("--rate", options->names.rate_hz, "Pairs a second where names tell no time (default 20)")
      ->check(CLI::Range(0.001, 10'000.0));
  command
      ->add_option("--pairs", options->names.pairs, "Stop after so many; where there are fewer, there and back again")
      ->check(CLI::Range(1, 10'000'000));
  command->add_option("--report", options->report, "File for figures of the run (JSON)")->check(output_place());
  command->add_option("--map", options->map, "File for the map's points (PLY)")->check(output_place());
  command->add_option("--overlay", options->overlay, "Folder for pictures of the features")->check(output_place());
  command
      ->add_option(
          "--enhance", options->enhance,
          "Enhance low light first (see `pharos enhance`); its denoiser: bm3d (default), bm3d-video (a fifth of its "
          "time), fast or none; write --enhance=bm3d before a folder")
      ->type_name("[DENOISER]")
      ->expected(0, 1)
      ->default_str("bm3d")
      ->check(CLI::IsMember({"bm3d", "bm3d-video", "fast", "none"}));
  command
      ->add_option("--features", options->settings.features,
                   "Features a frame (default: 1000 for 640 x 480, more for larger images)")
      ->check(CLI::Range(100, 10'000));
  command->add_option("--max-keyframes", options->settings.max_keyframes, "Limit of keyframes; the paper's is 20")
      ->check(CLI::Range(5, 100'000));
  command->add_option("--vocabulary", options->settings.vocabulary, "Visual words (default: those that ship)");
  command->add_flag("--no-loops", options->no_loops, "Do not close loops, as in the paper");
  command->add_flag("--threads", options->threads,
                    "Tracking, mapping and loop closing at once: faster, but no two runs are alike to the bit");
  command->footer(kExample);
  command->callback([options, &exit_code] { exit_code = run_or_refuse(*options); });
}

}  // namespace pharos::tools
