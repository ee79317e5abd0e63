// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>
#include <string>

#include "host/support/input_error.hpp"
#include "tools/cli/progress.hpp"
#include "tools/cli/seed_option.hpp"
#include "tools/sim/add_sim.hpp"
#include "tools/sim/stereo/stereo_writer.hpp"
#include "tools/sim/stereo_tumbling/tumbling_options.hpp"

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
  CLI::App* command = sim.add_subcommand("stereo", "Simulate two cameras before docking ring and nozzle");
  const auto write_scene = add_tumbling_options(*command);
  command->add_option("SCENARIO", options->scenario,
                      "scenario file (TOML; examples in tools/sim/scenarios/stereo_*.toml); - is standard input");
  add_seed_option(*command, options->seed, "same seed, same bytes");
  command->add_option("--output", options->output, "directory for images, rig file, ellipses and truth")->required();
  command->footer(
      "Writes rig.toml, truth.csv, ellipses.csv (for pharos circles --ellipses) and, where it renders with POV-Ray,\n"
      "NNNN_left.png and NNNN_right.png.\n\n"
      "Example: pharos sim stereo tools/sim/scenarios/stereo_pairs.toml --seed 7 --output /tmp/pairs\n"
      "         pharos sim stereo --scene tumbling --turn-deg 30 --output /tmp/turn   (see pharos slam)");
  command->callback([options, write_scene, &exit_code] {
    exit_code = 0;
    if (write_scene(options->seed, options->output)) return;
    if (options->scenario.empty()) throw host::InputError("name a SCENARIO file, or --scene tumbling");
    const sim::StereoScenario scenario = sim::read_stereo_scenario(options->scenario, options->seed);
    Progress progress("simulated", "pairs", scenario.poses.size());
    sim::write_stereo_pairs(scenario, options->seed, options->output, [&progress] { progress.step(); });
    std::cerr << options->output << ": " << scenario.poses.size() << " pairs, rig.toml, ellipses.csv and truth.csv\n";
  });
}

}  // namespace pharos::tools
