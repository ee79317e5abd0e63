// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/connector_pair.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/base/units.hpp"
#include "pharos/tof/tof_pose.hpp"

namespace pharos::tof {
namespace {

// Two values agree within this many deviations.
constexpr double kGate = 4.0;
// So many frames in a row that disagree are of another body: one or two are a hidden connector or an outlier.
constexpr std::int32_t kMaxDisagreements = 3;
// A mean of many heights is not better than foil and reflections let a single one be, m.
constexpr double kMinHeightSigma_m = 0.0005;

double square(double value) { return value * value; }

// Where a face appears in the ring's plane if it stands a metre nearer to the camera: along its ray.
Vector2 place_per_height(const RingModel& ring, const ConnectorFace& face) {
  const PlaneAxes axes = axes_of(ring.normal);
  const Vector2& plan = face.rectangle.centre_m;
  const Vector3 point = ring.centre_m + plan.x() * axes.first + plan.y() * axes.second + face.height_m * ring.normal;
  return Vector2(axes.first.dot(point), axes.second.dot(point)) / ring.normal.dot(point);
}

// By this frame and the earlier ones: the face stays on its ray.
void set_height(const RingModel& ring, const LearntValue& learnt, ConnectorFace& face) {
  LearntValue height{face.height_m, square(face.sigma_height_m)};
  height.add(learnt.mean, learnt.variance + square(kMinHeightSigma_m));
  face.rectangle.centre_m += (height.mean - face.height_m) * place_per_height(ring, face);
  face.height_m = height.mean;
  face.sigma_height_m = std::sqrt(height.variance);
}

Matrix3 about_z(double angle) {
  Matrix3 m;
  m << std::cos(angle), -std::sin(angle), 0, std::sin(angle), std::cos(angle), 0, 0, 0, 1;
  return m;
}

}  // namespace

void LearntValue::add(double value, double value_variance) {
  const double gain = variance / (variance + value_variance);
  mean += gain * (value - mean);
  variance *= 1.0 - gain;
}

ConnectorPair::Place ConnectorPair::place_of(const RingModel& ring, const ConnectorFace& face) {
  const Vector2& plan = face.rectangle.centre_m;
  const Vector2 along = plan.normalized(), across(-along.y(), along.x());
  const Vector2 per_height = place_per_height(ring, face);
  const auto noise = [&](const Vector2& direction) {
    return direction.dot(face.covariance * direction) - face.common_variance_m2 +
           square(direction.dot(per_height) * face.sigma_height_m);
  };
  const double per_rad = plan.squaredNorm();
  return {std::atan2(plan.y(), plan.x()),    plan.norm(),
          noise(across) / per_rad,           noise(along),
          face.common_variance_m2 / per_rad, {face.height_m, square(face.sigma_height_m)}};
}

bool ConnectorPair::is_learnt_pair(const Places& places) const {
  double squares = 0.0;
  for (std::size_t k = 0; k < 2; ++k) {
    const LearntValue& learnt = learnt_[k].distance_m;
    // What this view and the earlier ones share.
    const double common = 2.0 * places[k].common_rad2 * square(places[k].distance_m);
    const double variance = places[k].distance_variance_m2 + learnt.variance + common;
    squares = std::max(squares, square(places[k].distance_m - learnt.mean) / variance);
  }
  const double apart = std::remainder(places[1].angle_rad - places[0].angle_rad - between_rad_.mean, kTwoPi);
  const double variance = places[0].variance_rad2 + places[1].variance_rad2 + between_rad_.variance +
                          2.0 * (places[0].common_rad2 + places[1].common_rad2);
  return std::max(squares, square(apart) / variance) < square(kGate);
}

void ConnectorPair::learn(const Places& places) {
  const double between = std::remainder(places[1].angle_rad - places[0].angle_rad - between_rad_.mean, kTwoPi);
  LearntValue measured{between_rad_.mean + between, places[0].variance_rad2 + places[1].variance_rad2};
  if (frames_ == 0)
    between_rad_ = measured;
  else
    between_rad_.add(measured.mean, measured.variance);
  for (std::size_t k = 0; k < 2; ++k) {
    const LearntValue distance{places[k].distance_m, places[k].distance_variance_m2};
    if (frames_ == 0) {
      learnt_[k] = {distance, places[k].height_m};
      continue;
    }
    learnt_[k].distance_m.add(distance.mean, distance.variance);
    learnt_[k].height_m.add(places[k].height_m.mean, places[k].height_m.variance);
  }
  ++frames_;
  disagreements_ = 0;
}

void ConnectorPair::refine(TofPose& pose) {
  if (!pose.has_turn() || pose.ambiguous() || pose.seen.size() < 2 || !pose.seen[0].sure || !pose.seen[1].sure) return;
  const RingModel& ring = pose.ring.fit.model;
  std::array<ConnectorFace, 2> faces = {pose.seen[0].face, pose.seen[1].face};
  const Places alone = {place_of(ring, faces[0]), place_of(ring, faces[1])};
  if (frames_ == 0) return learn(alone);
  if (!is_learnt_pair(alone)) {
    if (++disagreements_ < kMaxDisagreements) return;
    frames_ = 0;
    return learn(alone);
  }
  for (std::size_t k = 0; k < 2; ++k) set_height(ring, learnt_[k].height_m, faces[k]);
  Places places = {place_of(ring, faces[0]), place_of(ring, faces[1])};
  turn_by(places, alone[0], pose);
  pose.connector = faces[0];
  // Heights as measured: those of `places` hold the learnt ones already.
  for (std::size_t k = 0; k < 2; ++k) places[k].height_m = alone[k].height_m;
  learn(places);
}

void ConnectorPair::turn_by(const Places& places, const Place& alone, TofPose& pose) const {
  const auto& [first, second] = places;
  const double apart = std::remainder(second.angle_rad - first.angle_rad - between_rad_.mean, kTwoPi);
  const double by_second = second.variance_rad2 + between_rad_.variance;
  const double weight = first.variance_rad2 / (first.variance_rad2 + by_second);
  const double turn = first.angle_rad + weight * apart;
  // The angle between both was learnt from other views, perhaps: what these shared is in it once more.
  const double variance = square(1.0 - weight) * (first.variance_rad2 + first.common_rad2) +
                          square(weight) * (by_second + first.common_rad2 + 2.0 * second.common_rad2);
  const double before = alone.variance_rad2 + alone.common_rad2;
  const Vector3& normal = pose.ring.fit.model.normal;
  TargetPose& target = pose.target;
  target.pose.R = target.pose.R * about_z(std::remainder(turn - alone.angle_rad, kTwoPi));
  target.covariance.topLeftCorner<3, 3>() += (std::min(variance, before) - before) * normal * normal.transpose();
}

}  // namespace pharos::tof
