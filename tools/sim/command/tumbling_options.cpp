// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/command/tumbling_options.hpp"

#include <memory>

#include "tools/sim/stereo_tumbling/board_pairs.hpp"
#include "tools/sim/stereo_tumbling/body_sequence.hpp"
#include "tools/sim/stereo_tumbling/room_sequence.hpp"
#include "tools/sim/stereo_tumbling/street_sequence.hpp"
#include "tools/sim/stereo_tumbling/tumbling_sequence.hpp"
#include "tools/support/progress.hpp"

namespace pharos::tools {
namespace {

struct SceneArguments {
  std::string scene, renderer = "povray", light = "good";
  sim::TumblingScenario scenario;
  sim::RoomScenario room;
  sim::StreetScenario street;
  int board_pairs = 15;
};

bool write_scene(SceneArguments options, std::uint64_t seed, const std::string& directory) {
  if (options.scene.empty()) return false;
  if (options.scene == "room") {
    Progress progress("rendered", "pairs", static_cast<std::size_t>(sim::RoomSequence(options.room, seed).frames()));
    sim::write_room(options.room, seed, directory, [&progress] { progress.step(); });
    return true;
  }
  if (options.scene == "street") {
    const auto pairs = static_cast<std::size_t>(sim::StreetSequence(options.street, seed).frames());
    Progress progress("rendered", "pairs", pairs);
    sim::write_street(options.street, seed, directory, [&progress] { progress.step(); });
    return true;
  }
  if (options.scene == "body") {
    const sim::BodyScenario body{options.scenario.turn_deg, options.scenario.step_deg};
    const auto pairs = static_cast<std::size_t>(body.turn_deg / body.step_deg) + 1;
    Progress progress("rendered", "pairs", pairs);
    sim::write_body(body, seed, directory, [&progress] { progress.step(); });
    return true;
  }
  if (options.scene == "boards") {
    Progress progress("rendered", "pairs", static_cast<std::size_t>(options.board_pairs));
    const host::RigFile rig = sim::tumbling_rig(options.scenario);
    sim::write_board_pairs(rig, options.board_pairs, seed, directory, [&progress] { progress.step(); });
    return true;
  }
  options.scenario.povray = options.renderer == "povray";
  options.scenario.good_light = options.light == "good";
  const auto pairs = static_cast<std::size_t>(options.scenario.turn_deg / options.scenario.step_deg) + 1;
  Progress progress("rendered", "pairs", pairs);
  sim::write_tumbling(options.scenario, seed, directory, [&progress] { progress.step(); });
  return true;
}

}  // namespace

std::function<bool(std::uint64_t, const std::string&)> add_tumbling_options(CLI::App& command) {
  const auto options = std::make_shared<SceneArguments>();
  command
      .add_option(
          "--scene", options->scene,
          "tumbling: a satellite that turns (paper 004); boards: its rig's calibration; room: a walk with a raw rig; "
          "street: a drive round a corner; body: a satellite drawn from the seed turns")
      ->check(CLI::IsMember({"tumbling", "body", "boards", "room", "street"}));
  command.add_option("--path-m", options->room.path_m, "room: length of the walk (default 60)")
      ->check(CLI::Range(0.0, 10'000.0));
  command.add_option("--straight-m", options->street.straight_m, "street: before and after the corner (default 36)")
      ->check(CLI::Range(0.0, 1000.0));
  command.add_option("--corner-deg", options->street.turn_deg, "street: to the left (default 90)")
      ->check(CLI::Range(0.0, 150.0));
  command.add_option("--step-m", options->street.step_m, "street: from pair to pair (default 1.2)")
      ->check(CLI::Range(0.01, 10.0));
  command
      .add_option("--rig-yaw-deg", options->street.rig_yaw_deg,
                  "street: the right camera is turned by this, which the rig file does not say (default 0)")
      ->check(CLI::Range(-1.0, 1.0));
  command.add_option("--pairs", options->board_pairs, "boards: how many (default 15; dots, 12 x 8, 80 mm, radius 20)")
      ->check(CLI::Range(1, 1000));
  command.add_option("--turn-deg", options->scenario.turn_deg, "tumbling, body: the whole turn (default 360)")
      ->check(CLI::Range(0.0, 7200.0));
  command.add_option("--step-deg", options->scenario.step_deg, "tumbling, body: a frame (default 0.5)")
      ->check(CLI::Range(0.01, 30.0));
  command
      .add_option("--light", options->light,
                  "tumbling: good (default; a lamp and the ambient light) or low (the ambient light alone)")
      ->check(CLI::IsMember({"good", "low"}));
  command.add_option("--ambient", options->scenario.ambient, "tumbling: ambient light (default 0.1)")
      ->check(CLI::Range(0.0, 1.0));
  command
      .add_option("--renderer", options->renderer,
                  "tumbling: povray (default), or rays: without gloss, in a tenth of the time; all others are rays")
      ->check(CLI::IsMember({"povray", "rays"}));
  return [options](std::uint64_t seed, const std::string& directory) { return write_scene(*options, seed, directory); };
}

}  // namespace pharos::tools
