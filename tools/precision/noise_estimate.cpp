// SPDX-License-Identifier: Apache-2.0
#include "tools/precision/noise_estimate.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/lighthouse/bearing.hpp"

namespace pharos::tools {
namespace {

constexpr std::int64_t kBlock = 60;      // turns: a second
constexpr std::size_t kMinInBlock = 30;  // hits of a sensor in a block that counts
constexpr int kMinBlocks = 6;
constexpr std::size_t kMinCommon = 200;  // turns that hit both sensors of a pair
// Means of blocks at rest scatter as their hits do over the square root of their number, with room for slow drifts of
// a rotor; those of a target that is carried scatter by far more.
constexpr double kMaxDrift = 30.0;
// Sensors of a rotor at rest agree to a few percent; one of a recording that is hit by a reflection too has four times
// their sigma.
constexpr double kMaxSigmaRatio = 2.0;

// Deviations from the mean of their block, by the turn's number.
struct Deviations {
  std::vector<std::pair<std::int64_t, double>> values;
  double squares = 0.0;
  double freedom = 0.0;
  std::vector<double> block_means;
  double per_block = 0.0;  // hits
  double variance() const { return squares / freedom; }
};

template <class Series>
Deviations deviations_of(const Series& series) {
  Deviations out;
  for (auto begin = series.begin(); begin != series.end();) {
    const std::int64_t block = begin->number / kBlock;
    const auto end =
        std::find_if(begin, series.end(), [block](const auto& turn) { return turn.number / kBlock != block; });
    const auto count = static_cast<std::size_t>(end - begin);
    if (count >= kMinInBlock) {
      double mean = 0.0;
      for (auto turn = begin; turn != end; ++turn) mean += turn->theta_rad / static_cast<double>(count);
      for (auto turn = begin; turn != end; ++turn) {
        out.values.emplace_back(turn->number, turn->theta_rad - mean);
        out.squares += (turn->theta_rad - mean) * (turn->theta_rad - mean);
      }
      out.freedom += static_cast<double>(count) - 1.0;
      out.block_means.push_back(mean);
      out.per_block += static_cast<double>(count);
    }
    begin = end;
  }
  if (!out.block_means.empty()) out.per_block /= static_cast<double>(out.block_means.size());
  return out;
}

// Variance of the blocks' means over that of means of independent angles.
double drift_of(const Deviations& d) {
  double mean = 0.0, squares = 0.0;
  const auto count = static_cast<double>(d.block_means.size());
  for (const double value : d.block_means) mean += value / count;
  for (const double value : d.block_means) squares += (value - mean) * (value - mean);
  return squares / (count - 1.0) * d.per_block / d.variance();
}

// Takes out the sensors whose sigma is far from the median of all; returns their number.
int leave_out_suspects(std::vector<Deviations>& sensors) {
  std::vector<double> variances;
  for (const Deviations& sensor : sensors) variances.push_back(sensor.variance());
  const auto middle = variances.begin() + static_cast<std::ptrdiff_t>(variances.size() / 2);
  std::nth_element(variances.begin(), middle, variances.end());
  constexpr double kMax = kMaxSigmaRatio * kMaxSigmaRatio;
  return static_cast<int>(std::erase_if(sensors, [median = *middle](const Deviations& sensor) {
    return sensor.variance() > kMax * median || sensor.variance() * kMax < median;
  }));
}

std::optional<double> correlation_of(const Deviations& a, const Deviations& b) {
  double ab = 0.0, aa = 0.0, bb = 0.0;
  std::size_t common = 0;
  auto other = b.values.begin();
  for (const auto& [number, value] : a.values) {
    while (other != b.values.end() && other->first < number) ++other;
    if (other == b.values.end()) break;
    if (other->first != number) continue;
    ++common;
    ab += value * other->second;
    aa += value * value;
    bb += other->second * other->second;
  }
  if (common < kMinCommon || aa <= 0.0 || bb <= 0.0) return std::nullopt;
  return ab / std::sqrt(aa * bb);
}

}  // namespace

NoiseVerdict RotorNoise::verdict() const {
  if (!(drift <= kMaxDrift)) return NoiseVerdict::kMoving;
  return left_out > 0 && sensors <= std::max(left_out, 1) ? NoiseVerdict::kDisagree : NoiseVerdict::kOk;
}

void NoiseEstimator::push(const lighthouse::Sweep& sweep) {
  Rotor& rotor = rotors_[{sweep.flash.station, sweep.flash.axis}];
  const std::int64_t number = rotor.turns++;
  const auto bearings = lighthouse::bearings_of(sweep);
  for (const lighthouse::Bearing& bearing : bearings) {
    // A second hit is a reflection of one of them: neither counts.
    const auto hits = std::count_if(bearings.begin(), bearings.end(),
                                    [&](const lighthouse::Bearing& one) { return one.sensor == bearing.sensor; });
    if (hits == 1) rotor.sensors[bearing.sensor].push_back({number, bearing.theta_rad});
  }
}

std::optional<RotorNoise> NoiseEstimator::noise_of(const Rotor& rotor) {
  RotorNoise noise;
  std::vector<Deviations> sensors;
  for (const auto& [sensor, series] : rotor.sensors) {
    Deviations deviations = deviations_of(series);
    if (static_cast<int>(deviations.block_means.size()) < kMinBlocks || !(deviations.variance() > 0.0)) continue;
    sensors.push_back(std::move(deviations));
  }
  if (sensors.empty()) return std::nullopt;
  noise.left_out = leave_out_suspects(sensors);
  noise.sensors = static_cast<int>(sensors.size());
  double variance = 0.0, rho = 0.0;
  int pairs = 0;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    noise.turns = std::max(noise.turns, static_cast<int>(sensors[i].values.size()));
    noise.drift = std::max(noise.drift, drift_of(sensors[i]));
    variance += sensors[i].variance() / static_cast<double>(sensors.size());
    for (std::size_t j = i + 1; j < sensors.size(); ++j) {
      if (const auto correlation = correlation_of(sensors[i], sensors[j])) {
        rho += *correlation;
        ++pairs;
      }
    }
  }
  noise.sigma_rad = std::sqrt(variance);
  if (pairs > 0) noise.rho = rho / pairs;
  return noise;
}

std::vector<RotorNoise> NoiseEstimator::estimate() const {
  std::vector<RotorNoise> all;
  for (const auto& [place, rotor] : rotors_) {
    if (auto noise = noise_of(rotor)) {
      noise->station = place.first;
      noise->axis = place.second;
      all.push_back(*noise);
    }
  }
  return all;
}

}  // namespace pharos::tools
