// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/stationary_average.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "pharos/base/ticks.hpp"
#include "pharos/base/units.hpp"

namespace pharos::calibrate {
namespace {

constexpr double kApart_rad = 150.0 * kRadPerArcsec;
constexpr double kShareOfSweeps = 0.3;
constexpr int kFewestSweeps = 5;
// Weight of the rotor's mean variance in the estimate of a sensor's own.
constexpr double kPriorSweeps = 20.0;
// Stamps are whole ticks of 1.6 arcsec: no mean of any number of them is better than this.
constexpr double kMinOwn_rad = 0.1 * kRadPerArcsec;

// One angle of one sweep.
struct Sample {
  double raw_rad;
  std::size_t sweep;
};

struct Candidate {
  std::uint8_t sensor = 0;
  double mean_rad = 0.0;
  std::vector<Sample> samples;
};

void add_candidates(std::uint8_t sensor, std::vector<Sample> samples, std::size_t sweeps,
                    std::vector<Candidate>& candidates) {
  std::sort(samples.begin(), samples.end(), [](const Sample& a, const Sample& b) { return a.raw_rad < b.raw_rad; });
  const double fewest = std::max<double>(kFewestSweeps, kShareOfSweeps * static_cast<double>(sweeps));
  for (std::size_t begin = 0; begin < samples.size();) {
    std::size_t end = begin + 1;
    while (end < samples.size() && samples[end].raw_rad - samples[end - 1].raw_rad < kApart_rad) ++end;
    if (static_cast<double>(end - begin) >= fewest) {
      Candidate candidate{
          sensor,
          0.0,
          {samples.begin() + static_cast<std::ptrdiff_t>(begin), samples.begin() + static_cast<std::ptrdiff_t>(end)}};
      for (const Sample& sample : candidate.samples) candidate.mean_rad += sample.raw_rad;
      candidate.mean_rad /= static_cast<double>(end - begin);
      candidates.push_back(std::move(candidate));
    }
    begin = end;
  }
}

std::vector<Candidate> candidates_of(std::span<const LoggedSweep* const> sweeps) {
  std::map<std::uint8_t, std::vector<Sample>> by_sensor;
  for (std::size_t k = 0; k < sweeps.size(); ++k) {
    for (const LoggedHit& hit : sweeps[k]->hits) by_sensor[hit.sensor].push_back({hit.raw_rad, k});
  }
  std::vector<Candidate> candidates;
  for (auto& [sensor, samples] : by_sensor) add_candidates(sensor, std::move(samples), sweeps.size(), candidates);
  return candidates;
}

// Splits every sample's deviation from its mean into a part common to the sweep's sensors and its own part.
RotorView view_of(const std::vector<Candidate>& candidates, std::size_t sweeps) {
  std::vector<double> shared(sweeps, 0.0);
  std::vector<int> sensors(sweeps, 0);
  for (const Candidate& candidate : candidates) {
    for (const Sample& sample : candidate.samples) {
      shared[sample.sweep] += sample.raw_rad - candidate.mean_rad;
      ++sensors[sample.sweep];
    }
  }
  RotorView view;
  view.sweeps = static_cast<int>(sweeps);
  for (std::size_t k = 0; k < sweeps; ++k) {
    if (sensors[k] > 0) shared[k] /= sensors[k];
    view.common_square_sum += shared[k] * shared[k];
  }
  for (const Candidate& candidate : candidates) {
    MeanBearing mean{candidate.sensor, candidate.mean_rad, static_cast<int>(candidate.samples.size()), 0.0, 0.0};
    for (const Sample& sample : candidate.samples) {
      const double own = sample.raw_rad - candidate.mean_rad - shared[sample.sweep];
      const int n = sensors[sample.sweep];
      // The mean over n sensors contains 1/n of a sensor's own part.
      if (n > 1) mean.own_square_sum += own * own * n / (n - 1.0);
    }
    view.bearings.push_back(mean);
  }
  return view;
}

struct RotorNoise {
  double own_square_sum = 0.0;
  double own_count = 0.0;
  double common_square_sum = 0.0;
  double common_count = 0.0;
  double sensors = 0.0;  // per sweep, summed over common_count

  double own_variance() const { return own_count > 0.0 ? own_square_sum / own_count : 0.0; }
  // The common mean contains 1/n of the own variance.
  double common_variance() const {
    if (common_count <= 0.0) return 0.0;
    const double both = common_square_sum / common_count;
    return std::max(both - own_variance() * common_count / std::max(sensors, 1.0), 0.25 * both);
  }
};

}  // namespace

StationaryAverage average_interval(const RecordingLog& recording, std::size_t recording_index,
                                   const StationaryInterval& interval, std::span<const std::size_t> station_of_slot) {
  StationaryAverage average;
  average.recording = recording_index;
  average.from_s = ticks_to_seconds(interval.from_ticks);
  average.to_s = ticks_to_seconds(interval.to_ticks);
  std::map<std::pair<std::uint8_t, Axis>, std::vector<const LoggedSweep*>> rotors;
  for (const LoggedSweep& sweep : recording.sweeps) {
    if (interval.holds(sweep.flash_ticks)) rotors[{sweep.slot, sweep.axis}].push_back(&sweep);
  }
  for (const auto& [rotor, sweeps] : rotors) {
    if (sweeps.size() < static_cast<std::size_t>(kFewestSweeps)) continue;
    RotorView view = view_of(candidates_of(sweeps), sweeps.size());
    view.station = station_of_slot[rotor.first];
    view.axis = rotor.second;
    if (!view.bearings.empty()) average.rotors.push_back(std::move(view));
  }
  return average;
}

void assign_sigmas(std::vector<StationaryAverage>& intervals) {
  std::map<std::pair<std::size_t, Axis>, RotorNoise> noise;
  for (const StationaryAverage& interval : intervals) {
    for (const RotorView& view : interval.rotors) {
      RotorNoise& rotor = noise[{view.station, view.axis}];
      rotor.common_square_sum += view.common_square_sum;
      rotor.common_count += view.sweeps - 1;
      for (const MeanBearing& bearing : view.bearings) {
        rotor.own_square_sum += bearing.own_square_sum;
        rotor.own_count += bearing.sweeps - 1;
        rotor.sensors += bearing.sweeps;
      }
    }
  }
  for (StationaryAverage& interval : intervals) {
    for (RotorView& view : interval.rotors) {
      const RotorNoise& rotor = noise[{view.station, view.axis}];
      view.common_sigma_rad = std::sqrt(rotor.common_variance() / view.sweeps);
      for (MeanBearing& bearing : view.bearings) {
        const double variance =
            (bearing.own_square_sum + kPriorSweeps * rotor.own_variance()) / (bearing.sweeps - 1 + kPriorSweeps);
        bearing.own_sigma_rad = std::max(std::sqrt(variance / bearing.sweeps), kMinOwn_rad);
        view.common_sigma_rad = std::max(view.common_sigma_rad, kMinOwn_rad);
      }
    }
  }
}

}  // namespace pharos::calibrate
