// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>
#include <string>

#include "host/support/input_error.hpp"
#include "tools/sim/command/add_sim.hpp"
#include "tools/sim/command/tumbling_options.hpp"
#include "tools/sim/ring2/ring2_writer.hpp"
#include "tools/support/output_place.hpp"
#include "tools/support/progress.hpp"
#include "tools/support/seed_option.hpp"

namespace pharos::tools {
namespace {

struct StereoOptions {
  std::string scenario;
  std::uint64_t seed = 1;
  std::string output;
};

}  // namespace

void add_sim_stereo(CLI::App& sim, int& exit_code) {
  auto options = std::make_shared<StereoOptions>();
  CLI::App* command = sim.add_subcommand(
      "stereo", "Simulate two cameras: before docking ring and nozzle, a tumbling satellite, in a room or street");
  const auto write_scene = add_tumbling_options(*command);
  command
      ->add_option("SCENARIO", options->scenario,
                   "scenario file (TOML; examples in tools/sim/scenarios/stereo_*.toml); - is standard input")
      ->excludes(command->get_option("--scene"));
  add_seed_option(*command, options->seed, "same seed, same bytes");
  command->add_option("--output", options->output, "directory for images, rig file, ellipses and truth")
      ->check(output_place())
      ->required();
  command->footer(
      "SCENARIO: rig.toml, truth.csv, ellipses.csv (for pharos circles --ellipses) and, where it renders with "
      "POV-Ray,\n"
      "NNNN_left.png and NNNN_right.png.\n"
      "--scene: left/ and right/ with images, rig.toml and, truth.tum (not of boards): for tumbling the "
      "satellite's\n"
      "poses as pharos slam gives them, for room and street the left camera's as pharos slam --output camera "
      "does.\n\n"
      "Example: pharos sim stereo tools/sim/scenarios/stereo_pairs.toml --seed 7 --output pairs\n"
      "         pharos sim stereo --scene tumbling --turn-deg 30 --renderer rays --output turn\n"
      "         pharos slam turn/left turn/right --rig turn/rig.toml > turn.tum && pharos evaluate turn.tum "
      "turn/truth.tum\n"
      "         pharos sim stereo --scene room --path-m 3 --output room\n"
      "         pharos slam room/left room/right --rig room/rig.toml --output camera > room.tum");
  command->callback([options, write_scene, &exit_code] {
    exit_code = 0;
    if (write_scene(options->seed, options->output)) return;
    if (options->scenario.empty()) throw host::InputError("name a SCENARIO file, or --scene tumbling");
    const sim::Ring2Scenario scenario = sim::read_ring2_scenario(options->scenario, options->seed);
    Progress progress("simulated", "pairs", scenario.poses.size());
    sim::write_ring2_pairs(scenario, options->seed, options->output, [&progress] { progress.step(); });
    std::cerr << options->output << ": " << scenario.poses.size() << " pairs, rig.toml, ellipses.csv and truth.csv\n";
  });
}

}  // namespace pharos::tools
