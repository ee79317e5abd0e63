// SPDX-License-Identifier: Apache-2.0
#include "pharos/pose/observation_table.hpp"

#include <cmath>

namespace pharos::pose {
namespace {

// Bearings closer than this to the plane of the rotors (rad) have no usable ray; a station sees 60 deg to each side.
constexpr double kGrazing_rad = 1e-6;

}  // namespace

int ObservationTable::add(const Vector3& position_m) {
  const auto k = static_cast<std::size_t>(count);
  body_x[k] = position_m.x();
  body_y[k] = position_m.y();
  body_z[k] = position_m.z();
  for (AxisColumns& columns : axis) {
    columns.cosine[k] = 0.0;
    columns.sine[k] = 1.0;
    columns.weight[k] = 0.0;
  }
  return count++;
}

void ObservationTable::see(int i, Axis a, double cosine, double sine) {
  AxisColumns& columns = axis[static_cast<std::size_t>(index_of(a))];
  const auto k = static_cast<std::size_t>(i);
  columns.cosine[k] = cosine;
  columns.sine[k] = sine;
  columns.weight[k] = 1.0;
}

void ObservationTable::pad() {
  if (count % 2 == 0) return;
  const auto last = static_cast<std::size_t>(count - 1);
  body_x[last + 1] = body_x[last];
  body_y[last + 1] = body_y[last];
  body_z[last + 1] = body_z[last];
  for (AxisColumns& columns : axis) {
    columns.cosine[last + 1] = 0.0;
    columns.sine[last + 1] = 1.0;
    columns.weight[last + 1] = 0.0;
  }
}

int ObservationTable::rows() const {
  double sum = 0.0;
  for (const AxisColumns& columns : axis) {
    for (int i = 0; i < count; ++i) sum += columns.weight[static_cast<std::size_t>(i)];
  }
  return static_cast<int>(sum);
}

int ObservationTable::sensors() const {
  int number = 0;
  for (int i = 0; i < count; ++i) number += seen(i, Axis::kX) || seen(i, Axis::kY) ? 1 : 0;
  return number;
}

Vector3 ObservationTable::body_centroid() const {
  Vector3 sum = Vector3::Zero();
  double number = 0.0;
  for (int i = 0; i < count; ++i) {
    if (!seen(i, Axis::kX) && !seen(i, Axis::kY)) continue;
    sum += body(i);
    number += 1.0;
  }
  return number > 0.0 ? Vector3(sum / number) : sum;
}

Vector3 ray_of(double cosine_x, double sine_x, double cosine_y, double sine_y) {
  // (cot theta_x, cot theta_y, 1) without its divisions.
  const Vector3 direction(cosine_x * sine_y, cosine_y * sine_x, sine_x * sine_y);
  return direction / std::sqrt(direction.squaredNorm());
}

RaySet rays_of(const ObservationTable& table) {
  RaySet set;
  for (int i = 0; i < table.count; ++i) {
    if (!table.seen_by_both(i)) continue;
    const auto k = static_cast<std::size_t>(i);
    const double cx = table.axis[0].cosine[k], sx = table.axis[0].sine[k];
    const double cy = table.axis[1].cosine[k], sy = table.axis[1].sine[k];
    if (sx < kGrazing_rad || sy < kGrazing_rad) continue;
    const auto n = static_cast<std::size_t>(set.count++);
    set.body[n] = table.body(i);
    set.ray[n] = ray_of(cx, sx, cy, sy);
  }
  return set;
}

}  // namespace pharos::pose
