// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <string>

#include "tools/sim/command/add_sim.hpp"
#include "tools/sim/pointing/pointing_writer.hpp"
#include "tools/support/output_place.hpp"
#include "tools/support/progress.hpp"
#include "tools/support/seed_option.hpp"

namespace pharos::tools {
namespace {

struct PointingOptions {
  std::string scenario;
  std::uint64_t seed = 1;
  std::string output;
};

void run(const PointingOptions& options) {
  const sim::PointingScenario scenario = sim::read_pointing_scenario(options.scenario, options.seed);
  Progress progress("rendered", "images", scenario.views.size());
  sim::write_pointing_images(scenario, options.seed, options.output, [&progress] { progress.step(); });
}

}  // namespace

void add_sim_pointing(CLI::App& sim, int& exit_code) {
  auto options = std::make_shared<PointingOptions>();
  CLI::App* command = sim.add_subcommand("line", "Simulate a ground telescope and a satellite with solar panels");
  command
      ->add_option("SCENARIO", options->scenario,
                   "scenario file (TOML; examples in tools/sim/scenarios/line_*.toml); - is standard input")
      ->required();
  add_seed_option(*command, options->seed, "same seed, same bytes");
  command->add_option("--output", options->output, "directory for the images, the camera file, the track and the truth")
      ->check(output_place())
      ->required();
  command->footer(
      "Writes NNNN.png, camera.toml, track.csv (time, azimuth, elevation of each image) and truth.csv (the panel's\n"
      "axis in the station's frame and Earth-fixed). Needs the program povray.\n\n"
      "Example: pharos sim line tools/sim/scenarios/line_table1.toml --seed 7 --output /tmp/panel");
  command->callback([options, &exit_code] {
    run(*options);
    std::cerr << options->output << ": images, camera.toml, track.csv and truth.csv\n";
    exit_code = 0;
  });
}

}  // namespace pharos::tools
