// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "pharos/base/axis.hpp"
#include "pharos/base/capacity.hpp"
#include "pharos/track/epoch_tracker.hpp"
#include "tools/support/output.hpp"

namespace pharos::tools {

/// Mean and standard deviation of a stream of numbers, without storing them (Welford).
class RunningMoments {
 public:
  void push(double value) {
    ++count_;
    const double from_mean = value - mean_;
    mean_ += from_mean / static_cast<double>(count_);
    squares_ += from_mean * (value - mean_);
  }
  std::int64_t count() const { return count_; }
  double mean() const { return mean_; }
  /// Standard deviation; empty below two values.
  std::optional<double> deviation() const {
    if (count_ < 2) return std::nullopt;
    return std::sqrt(squares_ / static_cast<double>(count_ - 1));
  }
  double rms() const { return count_ == 0 ? 0.0 : std::sqrt(mean_ * mean_ + squares_ / static_cast<double>(count_)); }

 private:
  std::int64_t count_ = 0;
  double mean_ = 0.0;
  double squares_ = 0.0;
};

/// Residuals of every sensor's bearings over a recording, per station and axis: a misplaced sensor or hits of another
/// sensor show as a mean that is not zero.
class ResidualTable {
 public:
  /// One bearing of a cycle with a pose.
  void push(std::uint8_t station, const track::TrackedBearing& bearing);
  /// One row a station, axis and sensor: `station,axis,sensor,used,left_out,mean_arcsec,sd_arcsec,rms_arcsec`.
  void write(const OutputOptions& options) const;

 private:
  struct Cell {
    RunningMoments used;
    std::int64_t left_out = 0;
  };
  using SensorCells = std::array<Cell, kMaxSensors>;
  std::array<std::array<SensorCells, kAxes>, kMaxStations> cells_;
};

}  // namespace pharos::tools
