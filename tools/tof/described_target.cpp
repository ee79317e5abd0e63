// SPDX-License-Identifier: Apache-2.0
#include "tools/tof/described_target.hpp"

#include <algorithm>
#include <cmath>

namespace pharos::tools {
namespace {

// Seen at places nearer than this, it is one connector. Metres.
constexpr double kSamePlace_m = 0.03;
// A mean of few frames is not better than foil and walls let a single one be. Metres.
constexpr double kMinSigma_m = 0.0005;

host::StatedLength mean_of(const std::vector<double>& values) {
  double sum = 0.0, squares = 0.0;
  const auto count = static_cast<double>(values.size());
  for (const double value : values) sum += value;
  const double mean = sum / count;
  for (const double value : values) squares += (value - mean) * (value - mean);
  const double sigma = values.size() > 1 ? std::sqrt(squares / (count - 1.0) / count) : 0.0;
  return {mean, std::max(kMinSigma_m, sigma)};
}

double middle_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

void TargetLearner::add(const tof::TofPose& pose) {
  if (!pose.has_turn() || pose.ambiguous()) return;
  ++frames_;
  const tof::RingModel& ring = pose.ring.fit.model;
  outer_m_.push_back(ring.radius(tof::RingEdge::kOuter));
  inner_m_.push_back(ring.radius(tof::RingEdge::kInner));
  const tof::PlaneAxes axes = tof::axes_of(ring.normal);
  for (const tof::SeenConnector& seen : pose.seen) {
    const Vector2& place = seen.face.rectangle.centre_m;
    const Vector3 in_T = pose.target.pose.R.transpose() * (place.x() * axes.first + place.y() * axes.second);
    const auto same = std::find_if(connectors_.begin(), connectors_.end(), [&](const Seen& known) {
      return std::hypot(mean_of(known.x_m).value_m - in_T.x(), mean_of(known.y_m).value_m - in_T.y()) < kSamePlace_m;
    });
    Seen& into = same != connectors_.end() ? *same : connectors_.emplace_back();
    const Vector2 sides = 2.0 * seen.face.rectangle.half_sides_m;
    into.x_m.push_back(in_T.x());
    into.y_m.push_back(in_T.y());
    into.height_m.push_back(seen.face.height_m);
    into.long_m.push_back(sides.maxCoeff());
    into.short_m.push_back(sides.minCoeff());
  }
}

host::DockingTarget TargetLearner::learnt() const {
  host::DockingTarget file;
  if (frames_ == 0) return file;
  file.outer_radius = mean_of(outer_m_);
  file.inner_radius = mean_of(inner_m_);
  for (const Seen& seen : connectors_) {
    if (2 * seen.x_m.size() < frames_) continue;
    file.connectors.push_back({mean_of(seen.x_m),
                               mean_of(seen.y_m),
                               mean_of(seen.height_m),
                               {middle_of(seen.long_m), middle_of(seen.short_m)}});
  }
  return file;
}

}  // namespace pharos::tools
