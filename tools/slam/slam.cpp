// SPDX-License-Identifier: Apache-2.0
// pharos slam: stereo pairs to the poses of a target without a model (paper 004).
#include <CLI/CLI.hpp>
#include <memory>
#include <optional>

#include "host/cameras/rig_file.hpp"
#include "host/device/pair_names.hpp"
#include "host/images/grey_image.hpp"
#include "host/support/input_error.hpp"
#include "host/vision/enhance/eight_bits.hpp"
#include "host/vision/slam/slam_system.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/output.hpp"
#include "tools/cli/progress.hpp"
#include "tools/slam/slam_files.hpp"

namespace pharos::tools {
namespace {

constexpr const char* kExample =
    "Example:\n"
    "  pharos slam left right --rig rig.toml --report report.json --map map.ply > poses.tum\n"
    "Rows: timestamp tx ty tz qx qy qz qw, metres: the pose of the target in the left camera's frame, relative to its\n"
    "pose at the first frame (T_C_T with T = C then); --output camera gives its inverse. A frame that is lost has no\n"
    "row. --scene static: nothing is masked, the camera moves.";

struct Options {
  std::string left, right, rig;
  std::string scene = "target", output = "target";
  std::string report, map, overlay;
  double rate_hz = 20.0;
  std::size_t pairs = 0;  // 0: all
  bool no_loops = false, threads = false;
  std::string enhance;  // empty, or the denoiser
  slam::SlamSettings settings;
};

std::optional<enhance::EnhanceSettings> enhance_settings(const std::string& denoiser) {
  if (denoiser.empty()) return std::nullopt;
  enhance::EnhanceSettings settings;
  if (denoiser == "fast") settings.denoiser = enhance::Denoiser::kFast;
  if (denoiser == "none") settings.denoiser = enhance::Denoiser::kNone;
  return settings;
}

// So many pairs: the first ones; of more than there are, all of them there and back again, at even times.
std::vector<host::PairName> prolonged(const std::vector<host::PairName>& pairs, std::size_t wanted) {
  if (wanted <= pairs.size()) return {pairs.begin(), pairs.begin() + static_cast<std::ptrdiff_t>(wanted)};
  if (pairs.size() < 2) throw host::InputError(pairs.front().left + ": one pair cannot be gone through there and back");
  const std::size_t last = pairs.size() - 1;
  const double step_s = (pairs.back().time_s - pairs.front().time_s) / static_cast<double>(last);
  std::vector<host::PairName> out;
  for (std::size_t k = 0; k < wanted; ++k) {
    const std::size_t place = k % (2 * last);
    out.push_back(pairs[place <= last ? place : 2 * last - place]);
    out.back().time_s = pairs.front().time_s + step_s * static_cast<double>(k);
  }
  return out;
}

int run(Options options) {
  options.settings.scene = options.scene == "static" ? slam::Scene::kStatic : slam::Scene::kTarget;
  options.settings.close_loops = !options.no_loops;
  options.settings.threads = options.threads;
  for (const std::string& file : {options.report, options.map}) {
    if (!file.empty()) require_writable(file);
  }
  std::vector<host::PairName> pairs = host::pair_names(options.left, options.right, options.rate_hz);
  if (options.pairs > 0) pairs = prolonged(pairs, options.pairs);
  const auto system = slam::make_slam(host::read_rig_file(options.rig), options.rig, options.settings);
  enhance::EightBitPairs lit(enhance_settings(options.enhance));
  bool lost = false;
  std::vector<MemoryAt> memory;
  Progress progress("slam", "pairs", pairs.size());
  for (const host::PairName& pair : pairs) {
    const host::GreyImage left = host::read_grey_image(pair.left), right = host::read_grey_image(pair.right);
    const slam::TrackedFrame frame = system->push(pair.time_s, lit.of(left.view(), 0), lit.of(right.view(), 1));
    if (frame.lost && !lost) note(pair.left + ": tracking is lost; looking for known views");
    lost = frame.lost;
    if (frame.relocalised) note(pair.left + ": found again");
    if (!options.overlay.empty()) write_slam_overlay(options.overlay, pair.stem, *system);
    progress.step();
    note_quarter(static_cast<std::size_t>(&pair - pairs.data()) + 1, pairs.size(), memory);
  }
  system->finish();
  const std::vector<slam::TrackedFrame> trajectory = system->trajectory();
  const int rows = write_tum(trajectory, options.output == "camera");
  if (!options.map.empty()) write_map_ply(options.map, system->points());
  if (!options.report.empty()) write_slam_report(options.report, system->report(), trajectory, memory);
  if (rows > 0) return kExitAnswered;
  note(options.left + ": no frame could be placed: " + std::to_string(system->report().frames) +
       " pairs, none with enough stereo features");
  return kExitNoAnswer;
}

}  // namespace

void add_slam(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("slam", "Stereo pairs to the poses of a target without a model");
  const auto options = std::make_shared<Options>();
  command->add_option("LEFT", options->left, "Folder of left images, raw or rectified, in order of their names")
      ->required();
  command->add_option("RIGHT", options->right, "Folder of right images")->required();
  command->add_option("--rig", options->rig, "Rig file (TOML)")->required();
  command->add_option("--scene", options->scene, "target: a body before dark or stillness; static: all of the image")
      ->check(CLI::IsMember({"target", "static"}));
  command->add_option("--output", options->output, "Poses of the target in the camera, or of the camera")
      ->check(CLI::IsMember({"target", "camera"}));
  command->add_option("--rate", options->rate_hz, "Pairs a second where names tell no time (default 20)")
      ->check(CLI::Range(0.001, 10'000.0));
  command->add_option("--pairs", options->pairs, "Stop after so many; where there are fewer, there and back again")
      ->check(CLI::Range(1, 10'000'000));
  command->add_option("--report", options->report, "File for figures of the run (JSON)");
  command->add_option("--map", options->map, "File for the map's points (PLY)");
  command->add_option("--overlay", options->overlay, "Folder for pictures of the features");
  command
      ->add_option("--enhance", options->enhance,
                   "Enhance low light first (see `pharos enhance`); its denoiser: bm3d (default), fast or none")
      ->type_name("[DENOISER]")
      ->expected(0, 1)
      ->default_str("bm3d")
      ->check(CLI::IsMember({"bm3d", "fast", "none"}));
  command->add_option("--features", options->settings.features, "Features a frame (default 1000)")
      ->check(CLI::Range(100, 10'000));
  command->add_option("--max-keyframes", options->settings.most_keyframes, "Limit of keyframes; the paper's is 20")
      ->check(CLI::Range(5, 100'000));
  command->add_option("--vocabulary", options->settings.vocabulary, "Visual words (default: those that ship)");
  command->add_flag("--no-loops", options->no_loops, "Do not close loops, as in the paper");
  command->add_flag("--threads", options->threads,
                    "Tracking, mapping and loop closing at once: faster, but no two runs are alike to the bit");
  command->footer(kExample);
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace pharos::tools
