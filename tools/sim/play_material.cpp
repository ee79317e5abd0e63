// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/play_material.hpp"

#include <cmath>

#include "host/support/input_error.hpp"

namespace pharos::sim {
namespace {

PlayMaterial open_scenario(const std::string& path, std::uint64_t seed) {
  PlayMaterial material;
  material.simulator = std::make_unique<LighthouseSimulator>(read_scenario(path, seed), seed);
  LighthouseSimulator* simulator = material.simulator.get();
  material.feed = std::make_unique<PulseFeed>([simulator]() -> std::optional<lighthouse::RawPulse> {
    const auto pulse = simulator->next();
    if (!pulse) return std::nullopt;
    return lighthouse::RawPulse{pulse->rise_ticks, pulse->fall_ticks, pulse->sensor};
  });
  material.clock.seconds_at = [simulator](std::int64_t ticks) {
    return simulator->clock().true_time(static_cast<double>(ticks) * 20e-9);
  };
  material.clock.ticks_at = [simulator](double time_s) { return simulator->clock().stamp(time_s); };
  material.sensors = 0;
  for (const SensorPlacement& sensor : simulator->nominal_target()) material.sensors |= 1u << sensor.sensor;
  return material;
}

PlayMaterial open_recording(const std::string& path) {
  PlayMaterial material;
  material.edges = std::make_unique<host::EdgesReader>(host::ByteSource(path));
  host::EdgesReader* edges = material.edges.get();
  material.feed = std::make_unique<PulseFeed>([edges] { return edges->next(); });
  const std::optional<std::int64_t> first = material.feed->first_ticks();
  if (!first) throw host::InputError(path + ": holds no pulses; give a recording with light");
  const std::int64_t start = *first;
  material.clock.seconds_at = [start](std::int64_t ticks) { return static_cast<double>(ticks - start) * 20e-9; };
  material.clock.ticks_at = [start](double time_s) { return start + std::llround(time_s * 50e6); };
  return material;
}

bool is_scenario(const std::string& path) { return path.size() > 5 && path.substr(path.size() - 5) == ".toml"; }

}  // namespace

PlayMaterial open_play_material(const std::string& path, std::uint64_t seed) {
  return is_scenario(path) ? open_scenario(path, seed) : open_recording(path);
}

PlayTruth truth_of(const PlayMaterial& material, const std::string& file) {
  LighthouseSimulator* simulator = material.simulator.get();
  if (simulator == nullptr) throw host::InputError("--truth: a recording has none; leave it out, or play a scenario");
  const auto at = [simulator](std::size_t station, double time_s) {
    return simulator->truth(station, simulator->clock().counter_time(time_s));
  };
  return {at, simulator->stations().size(), simulator->scenario().duration_s, file};
}

}  // namespace pharos::sim
