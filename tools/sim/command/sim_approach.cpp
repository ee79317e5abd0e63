// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <string>

#include "tools/sim/approach/approach_writer.hpp"
#include "tools/sim/command/add_sim.hpp"
#include "tools/support/output_place.hpp"
#include "tools/support/seed_option.hpp"

namespace pharos::tools {
namespace {

struct ApproachOptions {
  std::string scenario;
  std::uint64_t seed = 1;
  std::string output;
};

void run(const ApproachOptions& options) {
  const sim::ApproachSimulator simulator(sim::read_approach_scenario(options.scenario), options.seed);
  const sim::ApproachSummary summary = sim::write_approach(simulator, options.output);
  std::cerr << options.output << ": truth.csv, mounting.toml";
  for (std::size_t i = 0; i < summary.seen.size(); ++i) {
    std::cerr << ", " << simulator.scenario().sources[i].name << ".csv with " << summary.seen[i] << " poses";
    if (summary.refused[i] > 0) std::cerr << " and " << summary.refused[i] << " refused";
  }
  std::cerr << "; " << simulator.faults().size() << " faults\n";
}

}  // namespace

void add_sim_approach(CLI::App& sim, int& exit_code) {
  auto options = std::make_shared<ApproachOptions>();
  CLI::App* command = sim.add_subcommand("approach", "Simulate an approach: one truth, the poses of all sources");
  command
      ->add_option("SCENARIO", options->scenario,
                   "scenario file (TOML; examples in tools/sim/scenarios/approach_*.toml); - is standard input")
      ->required();
  add_seed_option(*command, options->seed, "same seed, same bytes");
  command->add_option("--output", options->output, "directory for the tables, the truth and the mountings")
      ->check(output_place())
      ->required();
  command->footer(
      "Poses with each source's rate, delay, noise, bias and outages, no images. Writes NAME.csv of each source in "
      "the\n"
      "columns of its command (track, tof, circles, slam --format csv) with time_s, arrival_s and the full "
      "covariance;\n"
      "truth.csv: T_vehicle_target, velocity, angular rate; mounting.toml with a calibration's errors,\n"
      "mounting_true.toml without; faults.csv.\n\n"
      "Example: pharos sim approach tools/sim/scenarios/approach_nominal.toml --seed 7 --output /tmp/approach");
  command->callback([options, &exit_code] {
    run(*options);
    exit_code = 0;
  });
}

}  // namespace pharos::tools
