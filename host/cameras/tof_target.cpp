// SPDX-License-Identifier: Apache-2.0
#include "host/cameras/tof_target.hpp"

#include <algorithm>
#include <cmath>

#include "host/support/input_error.hpp"

namespace pharos::host {
namespace {

// A ring's radii are measured to a thousandth; deviations that a description states come on top.
constexpr double kRadiusMargin = 0.01;
constexpr double kSigmas = 5.0;

}  // namespace

void apply_target(const DockingTarget& target, const std::string& name, tof::TofSettings& settings) {
  if (target.outer_radius) {
    const double value = target.outer_radius->value_m;
    const double within = kRadiusMargin * value + kSigmas * target.outer_radius->sigma_m;
    settings.ring.min_outer_radius_m = value - within;
    settings.ring.max_outer_radius_m = value + within;
    if (target.inner_radius) {
      const double ratio = target.inner_radius->value_m / value;
      const double by = kRadiusMargin + kSigmas * (target.inner_radius->sigma_m + target.outer_radius->sigma_m) / value;
      settings.ring.min_radius_ratio = ratio - by;
      settings.ring.max_radius_ratio = std::min(0.99, ratio + by);
    }
  }
  settings.target.connectors.clear();
  for (const StatedConnector& one : target.connectors) {
    const tof::DescribedConnector connector{{one.x.value_m, one.y.value_m},
                                            one.height.value_m,
                                            {one.size_m[0], one.size_m[1]},
                                            std::hypot(one.x.sigma_m, one.y.sigma_m),
                                            one.height.sigma_m};
    if (!settings.target.connectors.push_back(connector)) {
      throw InputError(name + ": more than " + std::to_string(tof::kMaxDescribed) +
                       " connectors; leave out those farthest from the ring");
    }
  }
}

}  // namespace pharos::host
