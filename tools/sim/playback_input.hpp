// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "host/table/edges_reader.hpp"
#include "tools/sim/lighthouse_simulator.hpp"
#include "tools/sim/pulse_feed.hpp"
#include "tools/sim/truth_log.hpp"

namespace pharos::sim {

/// The input of a playback, a scenario (.toml) or a recording: its pulses and its clock.
struct PlaybackInput {
  std::unique_ptr<LighthouseSimulator> simulator;  // of a scenario
  std::unique_ptr<host::EdgesReader> edges;        // of a recording
  std::unique_ptr<PulseFeed> feed;
  PlayClock clock;
  std::uint32_t sensors = 0xFFFFFFFF;  // bit per sensor
};

/// Throws host::InputError if the file is neither, or has no pulses.
PlaybackInput open_playback_input(const std::string& path, std::uint64_t seed);
/// Its truth, to be written to `file`, in the body frame of the nominal sensor positions, which the true positions fit
/// by least squares if sensors have errors. Throws host::InputError for a recording, which has no truth.
PlayTruth truth_of(const PlaybackInput& input, const std::string& file);

}  // namespace pharos::sim
