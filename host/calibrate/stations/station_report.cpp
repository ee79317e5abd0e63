// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/stations/station_report.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "host/calibrate/stations/error_modes.hpp"
#include "pharos/geometry/symmetric.hpp"

namespace pharos::calibrate {
namespace {

constexpr double kOutlier = 5.0;  // times the middle deviation
constexpr std::size_t kLh1Fields = 5;

double sigma_of(const Eigen::MatrixXd& covariance, std::size_t k) {
  const auto i = static_cast<Eigen::Index>(k);
  return std::sqrt(std::max(0.0, covariance(i, i)));
}

PlaneFit fit_of(std::size_t station, std::size_t plane, const std::vector<UsedSweep>& sweeps,
                const std::vector<SweepResiduals>& residuals) {
  PlaneFit fit;
  std::vector<double> means;
  double own = 0.0, degrees = 0.0;
  for (std::size_t i = 0; i < sweeps.size(); ++i) {
    if (sweeps[i].sweep.station != station || sweeps[i].sweep.plane != plane) continue;
    const auto count = static_cast<double>(residuals[i].size());
    means.push_back(std::accumulate(residuals[i].begin(), residuals[i].end(), 0.0) / count);
    for (const double r : residuals[i]) own += (r - means.back()) * (r - means.back());
    degrees += count - 1.0;
  }
  fit.sweeps = means.size();
  if (means.empty()) return fit;
  fit.own_rad = degrees > 0.0 ? std::sqrt(own / degrees) : 0.0;
  std::vector<double> sizes;
  for (const double mean : means) sizes.push_back(std::abs(mean));
  const auto middle = sizes.begin() + std::ssize(sizes) / 2;
  std::nth_element(sizes.begin(), middle, sizes.end());
  const double limit_rad = kOutlier * *middle;
  double square = 0.0;
  for (const double mean : means) {
    if (std::abs(mean) > limit_rad) {
      ++fit.outliers;
    } else {
      square += mean * mean;
    }
  }
  fit.mean_rad = std::sqrt(square / static_cast<double>(fit.sweeps - fit.outliers));
  return fit;
}

// Every length of the room: of the distances between the first station and the others, weighted by themselves.
double scale_sigma_of(const network::Stations& stations, const Eigen::MatrixXd& covariance) {
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(covariance.cols());
  double length_m = 0.0;
  for (std::size_t s = 1; s < stations.size(); ++s) {
    const Vector3 apart = stations[s].T_world_station->t - stations[0].T_world_station->t;
    gradient.segment<3>(static_cast<Eigen::Index>(s * kStationColumns + 3)) = apart.normalized();
    length_m += apart.norm();
  }
  return std::sqrt(std::max(0.0, gradient.dot(covariance * gradient))) / std::max(length_m, 1e-9);
}

std::string plane_name(network::Generation generation, std::size_t plane) {
  if (generation == network::Generation::kLighthouse1) return plane == 0 ? "x" : "y";
  return plane == 0 ? "a" : "b";
}

void add_station(const network::Station& prior, const network::Station& station, const Eigen::MatrixXd& covariance,
                 std::size_t at, bool gauge, std::vector<StationParameter>& out) {
  constexpr std::array<const char*, 6> kPose = {
      "rotation_x_rad", "rotation_y_rad", "rotation_z_rad", "x_m", "y_m", "z_m"};
  const std::string name = "station " + std::to_string(station.number) + " ";
  for (std::size_t k = 0; k < 6 && !gauge; ++k) {
    const double value = k < 3 ? 0.0 : station.T_world_station->t[static_cast<Eigen::Index>(k - 3)];
    out.push_back({name + kPose[k], 0.0, 0.0, value, sigma_of(covariance, at + k)});
  }
  for (std::size_t p = 0; p < network::kPlanes; ++p) {
    const PlaneFields before = fields_of(prior.plane[p]), after = fields_of(station.plane[p]);
    const PlaneFields sigma = prior_sigmas(prior.generation, before);
    const bool first = station.generation == network::Generation::kLighthouse1;
    for (std::size_t f = 0; f < (first ? kLh1Fields : kPlaneFields); ++f) {
      out.push_back({name + "plane " + plane_name(station.generation, p) + " " + kPlaneFieldNames[f], sigma[f],
                     before[f], after[f], sigma_of(covariance, at + 6 + p * kPlaneFields + f)});
    }
  }
}

void add_sensors(const Target& nominal, const Target& target, double prior_sigma_m, const Eigen::MatrixXd& covariance,
                 std::size_t at, std::vector<StationParameter>& out) {
  constexpr std::array<const char*, 3> kAxes = {" x_m", " y_m", " z_m"};
  for (std::size_t i = 0; i < target.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      out.push_back({"sensor " + std::to_string(target[i].sensor) + kAxes[k], prior_sigma_m,
                     nominal[i].position_m[axis], target[i].position_m[axis], sigma_of(covariance, at + 3 * i + k)});
    }
  }
}

// What no field of a plane describes deforms the room by so much more than the angles that it leaves: two stations a
// room's width apart tell their directions from each other so much worse than a plane's angle. Beside motion capture
// rooms were deformed by 2.8 (LH1) and 1.2 permille (LH2) where planes left 0.8 and 0.27 mrad.
constexpr double kDeformation = 4.0;

double rms_of(const std::vector<std::array<double, network::kPlanes>>& planes) {
  double square = 0.0;
  for (const auto& station : planes) {
    for (const double value : station) square += value * value;
  }
  return std::sqrt(square / static_cast<double>(network::kPlanes * planes.size()));
}

// What hits of a sweep leave about their mean, as if the station were turned against the body.
double turned_sigma(const PlaneFit& fit, const network::Station& station, const Target& target, const Spread& spread) {
  double square = 0.0;
  for (const SensorPlacement& sensor : target) square += sensor.position_m.squaredNorm();
  const double radius_m = std::sqrt(square / static_cast<double>(target.size()));
  return fit.own_rad * (spread.centre_m - station.T_world_station->t).norm() / radius_m;
}

}  // namespace

Spread spread_of(const StationUnknowns& unknowns) {
  Spread out;
  double count = 0.0;
  for (const BodySpline& piece : unknowns.motion) {
    for (const auto& p : piece.position) out.centre_m += Eigen::Map<const Vector3>(p.data());
    count += static_cast<double>(piece.position.size());
  }
  if (count == 0.0) return out;
  out.centre_m /= count;
  Matrix3 C = Matrix3::Zero();
  for (const BodySpline& piece : unknowns.motion) {
    for (const auto& p : piece.position) {
      const Vector3 d = Eigen::Map<const Vector3>(p.data()) - out.centre_m;
      C += d * d.transpose() / count;
    }
  }
  const Vector3 values = symmetric_eigen<3>(C).values;
  out.sigma_m = values.reverse().cwiseMax(0.0).cwiseSqrt();
  return out;
}

void fill_report(const network::Stations& prior, const Target& nominal, const std::vector<UsedSweep>& sweeps,
                 double sensor_sigma_m, const StationBundleResult& result, StationCalibration& out) {
  const StationUnknowns& at = result.unknowns;
  out.stations = at.stations;
  for (network::Station& station : out.stations) {
    for (auto& plane : station.plane) plane = plane_of(with_phases_in_a_turn(fields_of(plane)));
  }
  out.sensors = at.target;
  out.converged = result.converged;
  out.sweeps = sweeps.size();
  for (const BodySpline& piece : at.motion) out.seconds += piece.end_s() - piece.begin_s();
  out.scale_sigma = scale_sigma_of(at.stations, result.covariance);
  const Spread spread = spread_of(at);
  const StationErrors errors = station_errors(at, result.covariance);
  for (std::size_t s = 0; s < at.stations.size(); ++s) {
    std::array<PlaneFit, network::kPlanes> fits;
    for (std::size_t p = 0; p < network::kPlanes; ++p) fits[p] = fit_of(s, p, sweeps, result.residuals);
    network::StationSigmas sigmas;
    for (std::size_t k = 0; k < 3; ++k) {
      sigmas.rotation_rad = std::max(sigmas.rotation_rad, sigma_of(result.covariance, s * kStationColumns + k));
    }
    for (std::size_t p = 0; p < network::kPlanes; ++p) {
      sigmas.rotation_rad = std::max(sigmas.rotation_rad, turned_sigma(fits[p], at.stations[s], at.target, spread));
      sigmas.plane_rad = std::max(sigmas.plane_rad, std::hypot(fits[p].mean_rad, errors.left_rad[s][p]));
    }
    // Beside the joint errors, in all directions.
    sigmas.scale = kDeformation * rms_of(errors.left_rad);
    sigmas.anchor_m = {spread.centre_m.x(), spread.centre_m.y(), spread.centre_m.z()};
    out.stations[s].sigmas = sigmas;
    out.stations[s].modes = errors.modes[s];
    out.fits.push_back(fits);
    add_station(prior[s], at.stations[s], result.covariance, s * kStationColumns, s == 0, out.parameters);
  }
  add_sensors(nominal, at.target, sensor_sigma_m, result.covariance, at.stations.size() * kStationColumns,
              out.parameters);
}

}  // namespace pharos::calibrate
