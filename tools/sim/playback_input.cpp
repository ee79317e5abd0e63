// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/playback_input.hpp"

#include <cmath>

#include "host/support/input_error.hpp"
#include "tools/sim/body_frame.hpp"

namespace pharos::sim {
namespace {

PlaybackInput open_scenario(const std::string& path, std::uint64_t seed) {
  PlaybackInput input;
  LighthouseScenario scenario = read_scenario(path, seed);
  if (scenario.generation != 1) {
    throw host::InputError(path +
                           ": a scenario of Lighthouse 2.0; pharos sim lighthouse and pharos sim serial play it");
  }
  input.simulator = std::make_unique<LighthouseSimulator>(std::move(scenario), seed);
  LighthouseSimulator* simulator = input.simulator.get();
  input.feed = std::make_unique<PulseFeed>([simulator]() -> std::optional<lighthouse::RawPulse> {
    const auto pulse = simulator->next();
    if (!pulse) return std::nullopt;
    return lighthouse::RawPulse{pulse->rise_ticks, pulse->fall_ticks, pulse->sensor};
  });
  input.clock.seconds_at = [simulator](std::int64_t ticks) {
    return simulator->clock().true_time(static_cast<double>(ticks) * 20e-9);
  };
  input.clock.ticks_at = [simulator](double time_s) { return simulator->clock().stamp(time_s); };
  input.sensors = 0;
  for (const SensorPlacement& sensor : simulator->nominal_target()) input.sensors |= 1u << sensor.sensor;
  return input;
}

PlaybackInput open_recording(const std::string& path) {
  PlaybackInput input;
  input.edges = std::make_unique<host::EdgesReader>(host::ByteSource(path));
  host::EdgesReader* edges = input.edges.get();
  input.feed = std::make_unique<PulseFeed>([edges] { return edges->next(); });
  const std::optional<std::int64_t> first = input.feed->first_ticks();
  if (!first) throw host::InputError(path + ": holds no pulses; give a recording with light");
  const std::int64_t start = *first;
  input.clock.seconds_at = [start](std::int64_t ticks) { return static_cast<double>(ticks - start) * 20e-9; };
  input.clock.ticks_at = [start](double time_s) { return start + std::llround(time_s * 50e6); };
  return input;
}

bool is_scenario(const std::string& path) { return path.size() > 5 && path.substr(path.size() - 5) == ".toml"; }

}  // namespace

PlaybackInput open_playback_input(const std::string& path, std::uint64_t seed) {
  return is_scenario(path) ? open_scenario(path, seed) : open_recording(path);
}

PlayTruth truth_of(const PlaybackInput& input, const std::string& file) {
  LighthouseSimulator* simulator = input.simulator.get();
  if (simulator == nullptr) throw host::InputError("--truth: a recording has none; leave it out, or play a scenario");
  const auto T_built_nominal = body_frame_of(simulator->nominal_target(), simulator->true_target());
  const auto at = [simulator, T_built_nominal](std::size_t station, double time_s) {
    return simulator->truth(station, simulator->clock().counter_time(time_s)) * T_built_nominal;
  };
  return {at, simulator->stations().size(), simulator->scenario().duration_s, file};
}

}  // namespace pharos::sim
