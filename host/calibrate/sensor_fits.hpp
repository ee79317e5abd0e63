// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <tuple>
#include <vector>

#include "host/calibrate/bundle.hpp"

namespace pharos::calibrate {

/// Residuals of one sensor on one rotor, rms over the stationary intervals.
struct SensorFit {
  std::size_t station = 0;
  Axis axis = Axis::kX;
  std::uint8_t sensor = 0;
  int intervals = 0;
  double before_rad = 0.0;  // nominal parameters, each interval's pose solved alone
  double after_rad = 0.0;
};

/// Gathers residuals by sensor and rotor.
class SensorFits {
 public:
  /// Residuals of the nominal parameters at the pose solved for each interval and station (`poses`, by interval).
  void add_before(const BundleProblem& problem, const std::vector<StationPoses>& poses);
  void add_after(const std::vector<StationaryAverage>& intervals, const std::vector<BearingResidual>& residuals);
  /// In the order of station, rotor, sensor.
  std::vector<SensorFit> table() const;

 private:
  struct Sum {
    double square = 0.0;
    int count = 0;
    void add(double residual_rad);
    double rms() const;
  };
  struct Cell {
    Sum before;
    Sum after;
  };
  std::map<std::tuple<std::size_t, Axis, std::uint8_t>, Cell> cells_;
};

}  // namespace pharos::calibrate
