// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/stations/error_modes.hpp"

#include <algorithm>
#include <cmath>

#include "host/calibrate/stations/station_bundle.hpp"
#include "host/linear/dense.hpp"

namespace pharos::calibrate {
namespace {

constexpr std::size_t kMaxPlaces = 200;
constexpr double kNearestPlace_m = 0.05;
constexpr double kFieldStep_rad = 1e-5;  // of central differences by the fields
constexpr Eigen::Index kPoseColumns = 6, kFieldColumns = static_cast<Eigen::Index>(network::kPlanes * kPlaneFields);
constexpr Eigen::Index kAllColumns = static_cast<Eigen::Index>(kStationColumns);

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<Vector3> places_of(const StationUnknowns& at) {
  std::size_t all = 0;
  for (const BodySpline& piece : at.motion) all += piece.position.size();
  const std::size_t step = std::max<std::size_t>(1, all / kMaxPlaces);
  std::vector<Vector3> out;
  std::size_t i = 0;
  for (const BodySpline& piece : at.motion) {
    for (const auto& p : piece.position) {
      if (i++ % step == 0) out.emplace_back(p[0], p[1], p[2]);
    }
  }
  return out;
}

// An angle's derivatives: by the place, by the station's pose, by the fields of the plane.
struct Derivatives {
  Vector3 by_place;
  Vector6 by_pose;
  Eigen::Matrix<double, 1, kFieldColumns> by_fields = Eigen::Matrix<double, 1, kFieldColumns>::Zero();
};

std::optional<Derivatives> derivatives_of(const network::Station& station, std::size_t plane, const Vector3& place_m) {
  const Vector3 from_m = place_m - station.T_world_station->t;
  const Vector3 p = station.T_world_station->R.transpose() * from_m;
  if (!(p.z() > kNearestPlace_m)) return std::nullopt;
  Derivatives out;
  out.by_place = station.T_world_station->R * network::ideal_gradient(station.generation, plane, p);
  out.by_pose << -from_m.cross(out.by_place), -out.by_place;
  network::Station other = station;
  for (std::size_t k = 0; k < kPlaneFields; ++k) {
    PlaneFields more = fields_of(station.plane[plane]), less = more;
    more[k] += kFieldStep_rad;
    less[k] -= kFieldStep_rad;
    other.plane[plane] = plane_of(more);
    const double up = network::raw_angle(other, plane, p);
    other.plane[plane] = plane_of(less);
    const double slope = (up - network::raw_angle(other, plane, p)) / (2.0 * kFieldStep_rad);
    out.by_fields[static_cast<Index>(plane * kPlaneFields + k)] = slope;
  }
  if (!out.by_fields.allFinite()) return std::nullopt;
  return out;
}

MatrixXd solve_all(const MatrixXd& A, const MatrixXd& B) {
  MatrixXd out(A.cols(), B.cols());
  for (Index k = 0; k < B.cols(); ++k) out.col(k) = host::dense_solve(A, B.col(k));
  return out;
}

// A station's fields as a turn of it: 3 x kFieldColumns; and what each plane leaves then.
MatrixXd turn_of_fields(const network::Station& station, const std::vector<Vector3>& places,
                        const MatrixXd& field_covariance, std::array<double, network::kPlanes>& left_rad) {
  MatrixXd A = 1e-12 * MatrixXd::Identity(3, 3), b = MatrixXd::Zero(3, kFieldColumns);
  std::vector<std::pair<std::size_t, Derivatives>> rows;
  for (const Vector3& place : places) {
    for (std::size_t plane = 0; plane < network::kPlanes; ++plane) {
      const auto row = derivatives_of(station, plane, place);
      if (!row) continue;
      rows.emplace_back(plane, *row);
      const Vector3 turn = row->by_pose.head<3>();
      A += turn * turn.transpose();
      b += turn * row->by_fields;
    }
  }
  MatrixXd turn = solve_all(A, b);
  std::array<double, network::kPlanes> square{}, count{};
  for (const auto& [plane, row] : rows) {
    const Eigen::RowVectorXd left = row.by_fields - row.by_pose.head<3>().transpose() * turn;
    square[plane] += left.dot(left * field_covariance);
    count[plane] += 1.0;
  }
  for (std::size_t plane = 0; plane < network::kPlanes; ++plane) {
    left_rad[plane] = std::sqrt(std::max(0.0, square[plane]) / std::max(1.0, count[plane]));
  }
  return turn;
}

// How a place moves with the stations' poses: 3 x 6 n; of the planes that show it. Empty where one direction is open.
std::optional<MatrixXd> place_by_poses(const network::Stations& stations, const Vector3& place_m) {
  MatrixXd A = MatrixXd::Zero(3, 3), b = MatrixXd::Zero(3, kPoseColumns * static_cast<Index>(stations.size()));
  for (std::size_t s = 0; s < stations.size(); ++s) {
    for (std::size_t plane = 0; plane < network::kPlanes; ++plane) {
      const auto row = derivatives_of(stations[s], plane, place_m);
      if (!row) return std::nullopt;
      A += row->by_place * row->by_place.transpose();
      b.middleCols<kPoseColumns>(kPoseColumns * static_cast<Index>(s)) -= row->by_place * row->by_pose.transpose();
    }
  }
  return solve_all(A, b);
}

// A motion of the room: its effect on a point.
Eigen::Matrix<double, 3, 6> carried(const Vector3& p) {
  Eigen::Matrix<double, 3, 6> out;
  out << -skew(p), Matrix3::Identity();
  return out;
}

// Takes the motion of all places together out of the stations' errors.
MatrixXd without_room_motion(const network::Stations& stations, const std::vector<Vector3>& places) {
  const Index n = kPoseColumns * static_cast<Index>(stations.size());
  MatrixXd A = 1e-9 * MatrixXd::Identity(6, 6), b = MatrixXd::Zero(6, n);
  for (const Vector3& place : places) {
    const auto moved = place_by_poses(stations, place);
    if (!moved) continue;
    A += carried(place).transpose() * carried(place);
    b += carried(place).transpose() * *moved;
  }
  const MatrixXd room = solve_all(A, b);
  MatrixXd out = MatrixXd::Identity(n, n);
  for (std::size_t s = 0; s < stations.size(); ++s) {
    const Index at = kPoseColumns * static_cast<Index>(s);
    out.middleRows<3>(at) -= room.topRows<3>();
    out.middleRows<3>(at + 3) -= carried(stations[s].T_world_station->t) * room;
  }
  return out;
}

}  // namespace

StationErrors station_errors(const StationUnknowns& at, const MatrixXd& covariance) {
  const auto count = static_cast<Index>(at.stations.size());
  const std::vector<Vector3> places = places_of(at);
  StationErrors out;
  out.left_rad.resize(at.stations.size());
  MatrixXd poses = MatrixXd::Zero(kPoseColumns * count, kAllColumns * count);
  for (Index s = 0; s < count; ++s) {
    const Index fields = kAllColumns * s + kPoseColumns;
    poses.block<kPoseColumns, kPoseColumns>(kPoseColumns * s, kAllColumns * s).setIdentity();
    poses.block(kPoseColumns * s, fields, 3, kFieldColumns) = turn_of_fields(
        at.stations[static_cast<std::size_t>(s)], places,
        covariance.block(fields, fields, kFieldColumns, kFieldColumns), out.left_rad[static_cast<std::size_t>(s)]);
  }
  const MatrixXd to_modes = without_room_motion(at.stations, places) * poses;
  const Index n = kAllColumns * count;
  const host::DenseEigen eigen = host::dense_eigen(to_modes * covariance.topLeftCorner(n, n) * to_modes.transpose());
  out.modes.resize(at.stations.size());
  for (Index k = eigen.values.size(); k-- > 0;) {  // the largest first
    if (!(eigen.values[k] > 0.0)) break;
    const VectorXd mode = std::sqrt(eigen.values[k]) * eigen.vectors.col(k);
    for (Index s = 0; s < count; ++s) {
      out.modes[static_cast<std::size_t>(s)].push_back(mode.segment<kPoseColumns>(kPoseColumns * s));
    }
  }
  return out;
}

}  // namespace pharos::calibrate
