// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/gather.hpp"

#include <algorithm>
#include <bitset>

#include "host/support/input_error.hpp"

namespace pharos::calibrate {
namespace {

using host::InputError;

std::string names_of(const std::vector<RecordingLog>& recordings) {
  std::string names;
  for (const RecordingLog& recording : recordings) names += (names.empty() ? "" : ", ") + recording.name;
  return names;
}

// Index of every slot's station. An unused slot has none.
std::vector<std::size_t> stations_of(const RecordingLog& recording,
                                     std::vector<lighthouse::StationCalibration>& stations) {
  std::vector<std::size_t> index(kMaxStations, 0);
  for (std::size_t slot = 0; slot < kMaxStations; ++slot) {
    const bool lit = std::any_of(recording.sweeps.begin(), recording.sweeps.end(),
                                 [slot](const LoggedSweep& sweep) { return sweep.slot == slot; });
    if (!lit) continue;
    const auto& station = recording.station[slot];
    if (!station) {
      throw InputError(recording.name + ": station " + std::to_string(slot) +
                       " did not tell its identity twice; record ten seconds in its light, or give --calibration FILE");
    }
    if (slot > 0 && recording.station[0] && recording.station[0]->id == station->id) {
      throw InputError(recording.name +
                       ": both stations say that they are the same one; one of them is not seen "
                       "directly: shade reflections");
    }
    const auto known =
        std::find_if(stations.begin(), stations.end(), [&](const auto& s) { return s.id == station->id; });
    index[slot] = static_cast<std::size_t>(known - stations.begin());
    if (known == stations.end()) {
      stations.push_back(*station);
    } else if (!(*known == *station)) {
      throw InputError(recording.name +
                       ": a station says other calibration values than in an earlier recording; "
                       "calibrate with recordings of after its change only");
    }
  }
  if (stations.size() > kMaxStations) {
    throw InputError(recording.name + ": more than two stations in the recordings; calibrate one pair at a time");
  }
  return index;
}

// Sensors that the target does not have are removed.
void remove_unknown_sensors(const Target& target, std::vector<StationaryAverage>& intervals,
                            std::size_t& unknown_sensors) {
  std::bitset<kMaxSensors> strange;
  for (StationaryAverage& interval : intervals) {
    for (RotorView& view : interval.rotors) {
      std::erase_if(view.bearings, [&](const MeanBearing& bearing) {
        if (find_sensor(target, bearing.sensor) != nullptr) return false;
        strange.set(bearing.sensor);
        return true;
      });
    }
  }
  unknown_sensors = strange.count();
}

void put_reference_first(Gathered& gathered) {
  if (gathered.stations.size() < 2) return;
  std::array<std::size_t, kMaxStations> seen{};
  for (const StationaryAverage& interval : gathered.intervals) {
    std::bitset<kMaxStations> here;
    for (const RotorView& view : interval.rotors) here.set(view.station);
    for (std::size_t s = 0; s < kMaxStations; ++s) seen[s] += here[s] ? 1U : 0U;
  }
  if (seen[0] >= seen[1]) return;
  std::swap(gathered.stations[0], gathered.stations[1]);
  for (StationaryAverage& interval : gathered.intervals) {
    for (RotorView& view : interval.rotors) view.station = 1 - view.station;
  }
}

}  // namespace

Gathered gather(const LighthouseCalibrationInput& input) {
  Gathered gathered;
  std::size_t sweeps = 0;
  std::size_t creeping = 0;
  std::size_t too_short = 0;
  for (std::size_t i = 0; i < input.recordings.size(); ++i) {
    const RecordingLog& recording = input.recordings[i];
    sweeps += recording.sweeps.size();
    const std::vector<std::size_t> station_of_slot = stations_of(recording, gathered.stations);
    const StationarySearch search = find_stationary_intervals(recording.sweeps);
    creeping += search.drifting;
    too_short += search.too_short;
    for (const StationaryInterval& interval : search.intervals) {
      gathered.intervals.push_back(average_interval(recording, i, interval, station_of_slot));
    }
  }
  const std::string names = names_of(input.recordings);
  if (sweeps == 0) {
    throw InputError(names + ": no sweep of a station; `pharos decode EDGES --stats` says what became of its pulses");
  }
  if (gathered.intervals.empty()) {
    throw InputError(names + ": the target never rested (too short, below 0.7 s: " + std::to_string(too_short) +
                     "; creeping: " + std::to_string(creeping) +
                     "); set it down or clamp it for two seconds in each of at least six poses");
  }
  remove_unknown_sensors(input.target, gathered.intervals, gathered.unknown_sensors);
  assign_sigmas(gathered.intervals);
  put_reference_first(gathered);
  return gathered;
}

}  // namespace pharos::calibrate
