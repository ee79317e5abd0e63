// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/command/add_sim.hpp"

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <string>

#include "tools/sim/lh2/lh2_recording.hpp"
#include "tools/sim/recording_writer.hpp"
#include "tools/support/output_place.hpp"
#include "tools/support/seed_option.hpp"

namespace pharos::tools {
namespace {

struct LighthouseOptions {
  std::string scenario;
  std::uint64_t seed = 1;
  std::string output;
};

}  // namespace

void add_sim_lighthouse(CLI::App& sim, int& exit_code) {
  auto options = std::make_shared<LighthouseOptions>();
  CLI::App* command = sim.add_subcommand("lighthouse", "Simulate laser base stations and a target before them");
  command
      ->add_option("SCENARIO", options->scenario,
                   "scenario file (TOML; examples in tools/sim/scenarios); - is standard input")
      ->required();
  add_seed_option(*command, options->seed, "same seed, same bytes");
  command->add_option("--output", options->output, "directory for the recording, its truth and its target")
      ->check(output_place())
      ->required();
  command->footer(
      "Writes edges.csv.gz, truth.csv (T_lighthouse_body, a row per millisecond and station), target.csv,\n"
      "target_true.csv, stations.toml (calibrations as announced), stations_true.toml and faults.csv.\n"
      "A scenario of generation = 2 (Lighthouse 2.0): light.csv.gz for pharos decode --lh2-light in place of edges,\n"
      "truth.csv of T_world_body, stations.toml with the stations' poses, passes.csv: each pass of a laser plane.\n\n"
      "Example: pharos sim lighthouse tools/sim/scenarios/demo.toml --seed 7 --output /tmp/demo");
  command->callback([options, &exit_code] {
    const sim::LighthouseScenario scenario = sim::read_scenario(options->scenario, options->seed);
    exit_code = 0;
    if (scenario.generation == 2) {
      const auto light = sim::write_lh2_recording(scenario, options->seed, options->output);
      std::cerr << options->output << ": " << light.passes << " passes, " << light.changes << " changes in "
                << light.duration_s << " s, " << light.faults << " faults\n";
      return;
    }
    const sim::RecordingSummary summary = sim::write_recording(scenario, options->seed, options->output);
    std::cerr << options->output << ": " << summary.pulses << " pulses in " << summary.duration_s << " s, "
              << summary.faults << " faults\n";
  });
}

void add_sim(CLI::App& app, int& exit_code) {
  CLI::App* sim = app.add_subcommand("sim", "Simulate sensors: recordings with truth, and a target on a serial line");
  sim->require_subcommand(1);
  sim->footer("Example: pharos sim lighthouse tools/sim/scenarios/demo.toml --seed 7 --output demo");
  add_sim_lighthouse(*sim, exit_code);
  add_sim_tof(*sim, exit_code);
  add_sim_pointing(*sim, exit_code);
  add_sim_stereo(*sim, exit_code);
  add_sim_serial(*sim, exit_code);
  add_sim_capture(*sim, exit_code);
  add_sim_camera(*sim, exit_code);
  add_sim_approach(*sim, exit_code);
}

}  // namespace pharos::tools
