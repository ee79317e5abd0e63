// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <charconv>
#include <fstream>
#include <iostream>
#include <memory>
#include <string>

#include "host/support/input_error.hpp"
#include "tools/sim/command/add_sim.hpp"
#include "tools/sim/lh2/lh2_feed.hpp"
#include "tools/sim/playback_input.hpp"
#include "tools/sim/serial_player.hpp"
#include "tools/support/number_option.hpp"
#include "tools/support/output_place.hpp"
#include "tools/support/seed_option.hpp"

namespace pharos::tools {
namespace {

using host::InputError;

struct SerialArguments {
  std::string input;
  std::string link;
  std::string truth;
  std::string name;
  std::vector<std::string> unplugs;
  bool raw_edges = false;
  bool free_running = false;
  sim::SerialOptions serial;
};

sim::Unplug parse_unplug(const std::string& text) {
  sim::Unplug unplug;
  const std::size_t comma = text.find(',');
  const char* const end = text.data() + text.size();
  const auto at = std::from_chars(text.data(), end, unplug.at_s);
  const bool at_good = at.ec == std::errc() && comma != std::string::npos && at.ptr == text.data() + comma;
  const auto duration = at_good ? std::from_chars(at.ptr + 1, end, unplug.for_s) : at;
  if (!at_good || duration.ec != std::errc() || duration.ptr != end || unplug.at_s < 0.0 || unplug.for_s < 0.0) {
    throw InputError("--unplug " + text + ": give AT,FOR in seconds, as 5,1.5");
  }
  return unplug;
}

// Plays `feed` through a target of this identity into a pseudo-terminal.
int play(const SerialArguments& options, sim::TargetIdentity identity, sim::LightFeed& feed,
         const sim::PlayClock& clock, std::optional<sim::PlayTruth> truth) {
  identity.name = options.name;
  identity.unique_id = static_cast<std::uint32_t>(options.serial.seed);
  identity.modes = options.raw_edges ? wire::kModeRawEdges : wire::kModeSweeps;
  sim::SimulatedTarget target(identity);
  sim::SerialOptions serial = options.serial;
  for (const std::string& text : options.unplugs) serial.unplugs.push_back(parse_unplug(text));
  serial.wait_for_reader = !options.free_running;
  std::optional<sim::PseudoTerminal> line;
  // The truth file is there before the port is, so that whoever waits for the port finds both.
  if (!options.truth.empty()) std::ofstream(options.truth).flush();
  line.emplace(options.link);
  std::cout << line->path() << std::endl;
  sim::SerialPlayer player(feed, clock, target, *line, serial, std::move(truth));
  const sim::SerialSummary summary = player.play();
  std::cerr << "played " << summary.played_s << " s: " << summary.pulses
            << (identity.generation == 2 ? " changes, " : " pulses, ") << summary.sweeps << " sweeps, "
            << summary.payloads << " OOTX payloads, " << summary.bytes << " bytes (" << summary.bytes_unheard
            << " unheard, " << summary.bytes_corrupted << " corrupted, " << summary.bytes_dropped << " dropped), "
            << summary.frames_skipped << " frames given up" << (summary.stopped ? ", stopped" : "") << "\n";
  return summary.sweeps > 0 || summary.stopped ? 0 : 1;
}

int play_pulses(const SerialArguments& options) {
  sim::PlaybackInput input = sim::open_playback_input(options.input, options.serial.seed);
  std::optional<sim::PlayTruth> truth;
  if (!options.truth.empty()) truth = sim::truth_of(input, options.truth);
  sim::TargetIdentity identity;
  identity.sensors = input.sensors;
  return play(options, identity, *input.feed, input.clock, std::move(truth));
}

int play_lh2(const SerialArguments& options, sim::LighthouseScenario scenario) {
  if (options.raw_edges) throw InputError("--raw-edges: a target of Lighthouse 2.0 sends sweeps only; leave it out");
  sim::Lh2Simulator simulator(std::move(scenario), options.serial.seed);
  sim::Lh2Feed feed(simulator);
  std::optional<sim::PlayTruth> truth;
  if (!options.truth.empty()) truth = sim::lh2_truth_of(simulator, options.truth);
  sim::TargetIdentity identity;
  identity.generation = 2;
  for (const SensorPlacement& sensor : simulator.nominal_target()) identity.sensors |= 1U << sensor.sensor;
  return play(options, identity, feed, sim::clock_of(simulator), std::move(truth));
}

int play_input(const SerialArguments& options) {
  if (options.input.ends_with(".toml")) {
    sim::LighthouseScenario scenario = sim::read_scenario(options.input, options.serial.seed);
    if (scenario.generation == 2) return play_lh2(options, std::move(scenario));
  }
  return play_pulses(options);
}

}  // namespace

void add_sim_serial(CLI::App& sim, int& exit_code) {
  auto options = std::make_shared<SerialArguments>();
  CLI::App* command = sim.add_subcommand("serial", "Play a scenario or a recording as a target on a serial line");
  command
      ->add_option(
          "INPUT", options->input,
          "scenario (.toml; of either generation), or edges (sensor,rise_ticks,fall_ticks; - is standard input)")
      ->required();
  command->add_option("--link", options->link, "symbolic link to the port, for a daemon's configuration");
  command->add_option("--speed", options->serial.speed, "times real speed; 0: as fast as the reader reads")
      ->check(number_from(0.0, 1e4))
      ->capture_default_str();
  command->add_option("--baud", options->serial.baud, "speed of the line")
      ->check(number_from(1200.0, 1e8))
      ->capture_default_str();
  add_seed_option(*command, options->serial.seed, "of the scenario and of the line's faults");
  command->add_option("--name", options->name, "name that the target gives itself");
  command->add_option("--truth", options->truth, "write true poses here while playing (utime: microseconds UTC)")
      ->check(output_place());
  command->add_flag("--raw-edges", options->raw_edges, "diagnostic mode: every edge instead of sweeps");
  command->add_flag("--free-running", options->free_running, "do not wait until a program has opened the port");
  command->add_option("--corrupt", options->serial.corrupt_rate, "share of bytes with one bit flipped")
      ->check(number_from(0.0, 1.0));
  command->add_option("--drop", options->serial.drop_rate, "share of bytes lost")->check(number_from(0.0, 1.0));
  command->add_option("--unplug", options->unplugs, "AT,FOR: unplug the port at AT s for FOR s (may be repeated)");
  command->footer(
      "Prints the port's path and plays once a program opens it. Ends with the input, or on SIGINT or SIGTERM.\n\n"
      "Example: pharos sim serial tools/sim/scenarios/demo.toml --link /tmp/target --truth /tmp/truth.csv");
  command->callback([options, &exit_code] { exit_code = play_input(*options); });
}

}  // namespace pharos::tools
