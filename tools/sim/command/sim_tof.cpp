// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <string>

#include "tools/sim/command/add_sim.hpp"
#include "tools/sim/tof/tof_writer.hpp"
#include "tools/support/output_place.hpp"
#include "tools/support/progress.hpp"
#include "tools/support/seed_option.hpp"

namespace pharos::tools {
namespace {

struct TofOptions {
  std::string scenario;
  std::uint64_t seed = 1;
  std::string output;
};

void run(const TofOptions& options) {
  sim::TofSimulator simulator(sim::read_tof_scenario(options.scenario, options.seed), options.seed);
  Progress progress("rendered", "frames", static_cast<std::size_t>(simulator.frames()));
  sim::write_tof_frames(simulator, options.output, [&progress] { progress.step(); });
}

}  // namespace

void add_sim_tof(CLI::App& sim, int& exit_code) {
  auto options = std::make_shared<TofOptions>();
  CLI::App* command = sim.add_subcommand("tof", "Simulate a time-of-flight camera and a satellite before it");
  command
      ->add_option("SCENARIO", options->scenario,
                   "scenario file (TOML; examples in tools/sim/scenarios/tof_*.toml); - is standard input")
      ->required();
  add_seed_option(*command, options->seed, "same seed, same bytes");
  command->add_option("--output", options->output, "directory for the frames, the camera file and the truth")
      ->check(output_place())
      ->required();
  command->footer(
      "Writes NNNN_intensity.png and NNNN_depth.png (16 bit; or NNNN_abcy16.raw), camera.toml and truth.csv\n"
      "(T_camera_target of each frame).\n\n"
      "Example: pharos sim tof tools/sim/scenarios/tof_still.toml --seed 7 --output /tmp/frames");
  command->callback([options, &exit_code] {
    run(*options);
    std::cerr << options->output << ": frames, camera.toml and truth.csv\n";
    exit_code = 0;
  });
}

}  // namespace pharos::tools
