// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <charconv>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/support/input_error.hpp"
#include "tools/sim/approach/approach_writer.hpp"
#include "tools/sim/approach/raw/raw_writer.hpp"
#include "tools/sim/command/add_sim.hpp"
#include "tools/support/output_place.hpp"
#include "tools/support/progress.hpp"
#include "tools/support/seed_option.hpp"

namespace pharos::tools {
namespace {

struct ApproachOptions {
  std::string scenario;
  std::uint64_t seed = 1;
  std::string level = "measurements";
  std::string target;
  std::vector<std::string> rates;
  double from_s = 0.0;
  std::optional<double> to_s;
  std::string output;
};

// Empty where it is no number or out of range.
std::optional<double> rate_hz(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value >= 0.01 && value <= 1000.0 ? std::optional(value) : std::nullopt;
}

// NAME=HZ of a source.
void set_rate(const std::string& text, sim::ApproachScenario& scenario) {
  const std::size_t equals = text.find('=');
  const std::string name = text.substr(0, equals);
  for (sim::ApproachSource& source : scenario.sources) {
    if (source.name != name || equals == std::string::npos) continue;
    const std::optional<double> rate = rate_hz(std::string_view(text).substr(equals + 1));
    if (!rate) break;
    source.rate_hz = *rate;
    return;
  }
  throw host::InputError("--rate " + text + ": give NAME=HZ of one of the scenario's sources, 0.01 to 1000 Hz");
}

sim::ApproachScenario scenario_of(const ApproachOptions& options) {
  sim::ApproachScenario scenario = sim::read_approach_scenario(options.scenario);
  for (const std::string& rate : options.rates) set_rate(rate, scenario);
  scenario.from_s = options.from_s;
  scenario.to_s = options.to_s.value_or(scenario.to_s);
  return scenario;
}

void simulate_poses(const ApproachOptions& options) {
  const sim::ApproachSimulator simulator(scenario_of(options), options.seed);
  const sim::ApproachSummary summary = sim::write_approach(simulator, options.output);
  std::cerr << options.output << ": truth.csv, mounting.toml";
  for (std::size_t i = 0; i < summary.seen.size(); ++i) {
    std::cerr << ", " << simulator.scenario().sources[i].name << ".csv with " << summary.seen[i] << " poses";
    if (summary.refused[i] > 0) std::cerr << " and " << summary.refused[i] << " refused";
  }
  std::cerr << "; " << simulator.faults().size() << " faults\n";
}

void simulate_raw(const ApproachOptions& options) {
  sim::RawApproach approach;
  approach.scenario = scenario_of(options);
  approach.seed = options.seed;
  approach.level = options.level == "light" ? sim::ApproachLevel::kLight : sim::ApproachLevel::kImages;
  approach.target_file = options.target;
  const std::size_t images = sim::image_count(approach);
  Progress progress("rendered", "frames", images);
  sim::write_raw_approach(approach, options.output, [&progress] { progress.step(); });
  std::cerr << options.output << ": truth.csv, mounting.toml, a folder of raw data of each source, " << images
            << " frames\n";
}

void run(const ApproachOptions& options) {
  if (options.level == "measurements") return simulate_poses(options);
  if (options.target.empty()) throw host::InputError("--level " + options.level + " needs --target: the sensors");
  simulate_raw(options);
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
  command
      ->add_option("--level", options->level,
                   "measurements: poses; light: the lighthouse's edges; images: also depth frames and stereo pairs")
      ->check(CLI::IsMember({"measurements", "light", "images"}))
      ->capture_default_str();
  command->add_option("--target", options->target, "light, images: sensors of the lighthouse's target (CSV)");
  command->add_option("--rate", options->rates, "NAME=HZ: another rate of a source");
  command->add_option("--from", options->from_s, "Nothing is measured before this time of the approach, s")
      ->check(CLI::Range(0.0, 1e4));
  command->add_option("--to", options->to_s, "Nor after this one")->check(CLI::Range(0.0, 1e4));
  command->add_option("--output", options->output, "directory for the tables, the truth and the mountings")
      ->check(output_place())
      ->required();
  command->footer(
      "Poses with each source's rate, delay, noise, bias and outages. Writes NAME.csv of each source in "
      "the\n"
      "columns of its command (track, tof, circles, slam --format csv) with time_s, arrival_s and the full "
      "covariance;\n"
      "truth.csv: T_vehicle_target, velocity, angular rate; mounting.toml with a calibration's errors,\n"
      "mounting_true.toml without; faults.csv. --level light, images: a folder NAME in place of NAME.csv, for track, "
      "tof,\n"
      "circles and slam; one body, own rays; some 0.3 s an image, so choose --rate, --from, --to; clocks start at 1e6 "
      "s.\n\n"
      "Example: pharos sim approach tools/sim/scenarios/approach_nominal.toml --seed 7 --output /tmp/approach");
  command->callback([options, &exit_code] {
    run(*options);
    exit_code = 0;
  });
}

}  // namespace pharos::tools
