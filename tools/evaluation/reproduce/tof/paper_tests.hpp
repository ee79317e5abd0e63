// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "pharos/tof/tof_pose.hpp"
#include "tools/sim/tof/tof_simulator.hpp"

namespace pharos::tools {

/// The four tests of paper 000's section 2.4.
inline constexpr std::size_t kPaperTests = 4;

/// At rest at the tests' measured means, `frames` of each.
sim::TofScenario paper_scenario(int frames);

using Values = std::array<double, 6>;  ///< X, Y, Z in mm; angles (8) in degrees
Values values_of(const tof::CameraFromTarget& pose);

/// Running mean and deviation.
class Spread {
 public:
  void add(const Values& values) {
    ++count_;
    for (std::size_t i = 0; i < 6; ++i) {
      const double step = values[i] - mean_[i];
      mean_[i] += step / count_;
      squares_[i] += step * (values[i] - mean_[i]);
    }
  }
  int count() const { return count_; }
  double mean(std::size_t i) const { return mean_[i]; }
  double sigma(std::size_t i) const { return count_ > 1 ? std::sqrt(squares_[i] / (count_ - 1)) : 0.0; }

 private:
  int count_ = 0;
  Values mean_{};
  Values squares_{};
};

}  // namespace pharos::tools
