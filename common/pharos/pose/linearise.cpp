// SPDX-License-Identifier: Apache-2.0
#include "pharos/pose/linearise.hpp"

#include <cmath>

namespace pharos::pose {
namespace {

// Two sensors at a time: one SSE2 register; plain scalars where there is none.
using Lane = Eigen::Array<double, 2, 1>;
// ObservationTable's columns are 16-byte aligned and read from even indices.
Lane load(const ObservationTable::Column& column, int i) {
  return Eigen::Map<const Lane, Eigen::Aligned16>(column.data() + i);
}

// Up to this tangent the series below is exact to 1e-14 relative; beyond it the library's atan2 is used.
constexpr double kSeriesLimit = 0.02;

Lane arctangent(const Lane& opposite, const Lane& adjacent) {
  const Lane u = opposite / adjacent;
  const Lane square = u * u;
  if ((adjacent > 0.0).all() && (square < kSeriesLimit * kSeriesLimit).all()) {
    return u * (1.0 - square * (1.0 / 3.0 - square * (0.2 - square * (1.0 / 7.0))));
  }
  return {std::atan2(opposite[0], adjacent[0]), std::atan2(opposite[1], adjacent[1])};
}

// Residual of one axis and its derivatives by the point's coordinate along the axis and ahead; weighted.
struct LaneTerms {
  Lane residual, by_along, by_ahead;
};

struct AngleTerms {
  LaneTerms operator()(const ObservationTable::AxisColumns& c, int i, const Lane& along, const Lane& ahead) const {
    const Lane cosine = load(c.cosine, i), sine = load(c.sine, i), weight = load(c.weight, i);
    const Lane scale = weight / (along * along + ahead * ahead);
    return {weight * arctangent(ahead * cosine - along * sine, along * cosine + ahead * sine), -ahead * scale,
            along * scale};
  }
};

struct TangentTerms {
  LaneTerms operator()(const ObservationTable::AxisColumns& c, int i, const Lane& along, const Lane& ahead) const {
    const Lane cosine = load(c.cosine, i), sine = load(c.sine, i), weight = load(c.weight, i);
    const Lane inverse = weight / ahead;
    return {along * inverse - weight * cosine / sine, inverse, -along * inverse / ahead};
  }
};

struct Points {
  Lane qx, qy, qz;  // R b: from the body's origin, lighthouse axes
  Lane px, py, pz;  // R b + t
};

Points points_at(const ObservationTable& s, int i, const LighthouseFromBody& T) {
  const Lane bx = load(s.body_x, i), by = load(s.body_y, i), bz = load(s.body_z, i);
  Points p;
  p.qx = T.R(0, 0) * bx + T.R(0, 1) * by + T.R(0, 2) * bz;
  p.qy = T.R(1, 0) * bx + T.R(1, 1) * by + T.R(1, 2) * bz;
  p.qz = T.R(2, 0) * bx + T.R(2, 1) * by + T.R(2, 2) * bz;
  p.px = p.qx + T.t.x();
  p.py = p.qy + T.t.y();
  p.pz = p.qz + T.t.z();
  return p;
}

// The row of an axis is [q x g, g] with g the derivative by the point: g = (by_along, 0, by_ahead) for x and
// (0, by_along, by_ahead) for y. Its element of the other axis' translation is always zero and is not summed.
struct AxisSums {
  std::array<Lane, 6> rotation_rotation;
  std::array<Lane, 3> rotation_along, rotation_ahead, rotation_residual;
  Lane along_along, along_ahead, ahead_ahead, along_residual, ahead_residual, residual_residual;

  AxisSums() {
    rotation_rotation.fill(Lane::Zero());
    rotation_along.fill(Lane::Zero());
    rotation_ahead.fill(Lane::Zero());
    rotation_residual.fill(Lane::Zero());
    along_along = along_ahead = ahead_ahead = along_residual = ahead_residual = residual_residual = Lane::Zero();
  }

  void add(const Lane& r0, const Lane& r1, const Lane& r2, const LaneTerms& terms) {
    rotation_rotation[0] += r0 * r0;
    rotation_rotation[1] += r1 * r0;
    rotation_rotation[2] += r1 * r1;
    rotation_rotation[3] += r2 * r0;
    rotation_rotation[4] += r2 * r1;
    rotation_rotation[5] += r2 * r2;
    add_column(rotation_along, r0, r1, r2, terms.by_along);
    add_column(rotation_ahead, r0, r1, r2, terms.by_ahead);
    add_column(rotation_residual, r0, r1, r2, terms.residual);
    along_along += terms.by_along * terms.by_along;
    along_ahead += terms.by_along * terms.by_ahead;
    ahead_ahead += terms.by_ahead * terms.by_ahead;
    along_residual += terms.by_along * terms.residual;
    ahead_residual += terms.by_ahead * terms.residual;
    residual_residual += terms.residual * terms.residual;
  }

 private:
  static void add_column(std::array<Lane, 3>& sum, const Lane& r0, const Lane& r1, const Lane& r2, const Lane& by) {
    sum[0] += r0 * by;
    sum[1] += r1 * by;
    sum[2] += r2 * by;
  }
};

NormalEquations joined(const AxisSums& x, const AxisSums& y) {
  NormalEquations n;
  for (std::size_t k = 0; k < 6; ++k) n.matrix.lower[k] = (x.rotation_rotation[k] + y.rotation_rotation[k]).sum();
  for (std::size_t i = 0; i < 3; ++i) {
    n.matrix(3, i) = x.rotation_along[i].sum();
    n.matrix(4, i) = y.rotation_along[i].sum();
    n.matrix(5, i) = (x.rotation_ahead[i] + y.rotation_ahead[i]).sum();
    n.gradient[i] = (x.rotation_residual[i] + y.rotation_residual[i]).sum();
  }
  n.matrix(3, 3) = x.along_along.sum();
  n.matrix(4, 3) = 0.0;
  n.matrix(4, 4) = y.along_along.sum();
  n.matrix(5, 3) = x.along_ahead.sum();
  n.matrix(5, 4) = y.along_ahead.sum();
  n.matrix(5, 5) = (x.ahead_ahead + y.ahead_ahead).sum();
  n.gradient[3] = x.along_residual.sum();
  n.gradient[4] = y.along_residual.sum();
  n.gradient[5] = (x.ahead_residual + y.ahead_residual).sum();
  n.cost = (x.residual_residual + y.residual_residual).sum();
  return n;
}

template <class Terms>
NormalEquations linearise_with(const ObservationTable& s, const LighthouseFromBody& T, Terms terms_of) {
  AxisSums sum_x, sum_y;
  for (int i = 0; i < s.count; i += 2) {
    const Points p = points_at(s, i, T);
    const LaneTerms x = terms_of(s.axis[0], i, p.px, p.pz);
    sum_x.add(p.qy * x.by_ahead, p.qz * x.by_along - p.qx * x.by_ahead, -p.qy * x.by_along, x);
    const LaneTerms y = terms_of(s.axis[1], i, p.py, p.pz);
    sum_y.add(p.qy * y.by_ahead - p.qz * y.by_along, -p.qx * y.by_ahead, p.qx * y.by_along, y);
  }
  return joined(sum_x, sum_y);
}

template <class Terms>
double cost_with(const ObservationTable& s, const LighthouseFromBody& T, Terms terms_of) {
  Lane sum = Lane::Zero();
  for (int i = 0; i < s.count; i += 2) {
    const Points p = points_at(s, i, T);
    const Lane x = terms_of(s.axis[0], i, p.px, p.pz).residual;
    const Lane y = terms_of(s.axis[1], i, p.py, p.pz).residual;
    sum += x * x + y * y;
  }
  return sum.sum();
}

}  // namespace

NormalEquations linearise(const ObservationTable& table, const LighthouseFromBody& pose, Residual residual) {
  return residual == Residual::kAngle ? linearise_with(table, pose, AngleTerms{})
                                      : linearise_with(table, pose, TangentTerms{});
}

double cost_of(const ObservationTable& table, const LighthouseFromBody& pose, Residual residual) {
  return residual == Residual::kAngle ? cost_with(table, pose, AngleTerms{}) : cost_with(table, pose, TangentTerms{});
}

double angle_residual(double along, double ahead, double cosine, double sine) {
  return std::atan2(ahead * cosine - along * sine, along * cosine + ahead * sine);
}

Vector6 jacobian_of(const Vector3& body_m, Axis axis, const LighthouseFromBody& pose) {
  const Vector3 q = pose.R * body_m;
  const Vector3 p = q + pose.t;
  const double along = p[index_of(axis)];
  const double square = along * along + p.z() * p.z();
  Vector3 gradient = Vector3::Zero();
  gradient[index_of(axis)] = -p.z() / square;
  gradient.z() = along / square;
  Vector6 jacobian;
  jacobian << q.cross(gradient), gradient;
  return jacobian;
}

Row row_of(const ObservationTable& table, int sensor, Axis axis, const LighthouseFromBody& pose, Residual residual) {
  const auto k = static_cast<std::size_t>(sensor);
  const ObservationTable::AxisColumns& c = table.axis[static_cast<std::size_t>(index_of(axis))];
  const Vector3 p = pose * table.body(sensor);
  const double along = p[index_of(axis)], ahead = p.z();
  Row row;
  row.jacobian = jacobian_of(table.body(sensor), axis, pose);
  if (residual == Residual::kAngle) {
    row.residual = angle_residual(along, ahead, c.cosine[k], c.sine[k]);
  } else {
    row.residual = along / ahead - c.cosine[k] / c.sine[k];
    // (13): d theta / d u = -1 / (1 + u^2).
    row.jacobian *= -(1.0 + (along / ahead) * (along / ahead));
  }
  return row;
}

}  // namespace pharos::pose
