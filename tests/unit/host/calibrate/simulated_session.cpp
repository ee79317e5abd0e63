// SPDX-License-Identifier: Apache-2.0
#include "unit/host/calibrate/simulated_session.hpp"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <memory>

#include "host/linear/dense.hpp"
#include "host/table/target_file.hpp"
#include "pharos/lighthouse/decoder.hpp"

namespace pharos::calibrate::test {
namespace {

constexpr double kDark_s = 0.2;

double nees_of(const Eigen::MatrixXd& covariance, const Eigen::VectorXd& error, const Eigen::MatrixXd& basis) {
  const Eigen::VectorXd e = basis.transpose() * error;
  const Eigen::MatrixXd c = basis.transpose() * covariance * basis;
  return host::dense_mahalanobis_squared(e, c) / static_cast<double>(e.size());
}

}  // namespace

sim::LighthouseScenario scenario_of(const Session& session) {
  sim::LighthouseScenario scenario;
  scenario.target = host::read_target(PHAROS_TARGET).target;
  scenario.errors = sim::ErrorScenario::workshop();
  scenario.duration_s = session.poses * (session.rest_s + kDark_s);
  sim::StationScenario station;
  station.calibration.reset();
  if (session.stations == 2) {
    station.mode = sim::StationMode::kB;
    station.pose.t = {-0.7, 0.0, 0.0};
    scenario.stations.push_back(station);
    station.id = 0xC33B4DE1u;
    station.mode = sim::StationMode::kC;
    station.pose.t = {0.7, 0.1, 0.1};
    station.pose.R = rotation_exp(Vector3(0.05, -0.2, 0.03));
  }
  scenario.stations.push_back(station);
  sim::RandomStationaryPoses rest;
  rest.count = session.poses;
  rest.min_range_m = session.min_range_m;
  rest.max_range_m = session.max_range_m;
  rest.min_lit = 6;
  scenario.trajectory = std::make_shared<sim::StationaryTrajectory>(
      sim::random_stationary_poses(rest, scenario.target, scenario.light.max_incidence_deg,
                                   sim::RandomStream(session.seed, "calibration")),
      session.rest_s + kDark_s, kDark_s);
  return scenario;
}

RecordingLog record(sim::LighthouseSimulator& simulator) {
  RecordingLog log;
  log.name = "simulated";
  const auto decoder = std::make_unique<lighthouse::Decoder>();
  const auto take = [&] {
    while (const auto sweep = decoder->take_sweep()) log.push(*sweep);
    while (decoder->take_ootx()) {
    }
  };
  while (const auto pulse = simulator.next()) {
    lighthouse::RawPulse raw;
    raw.rise_ticks = pulse->rise_ticks;
    raw.fall_ticks = pulse->fall_ticks;
    raw.sensor = pulse->sensor;
    decoder->push(raw);
    take();
  }
  decoder->flush();
  take();
  for (std::size_t s = 0; s < simulator.stations().size(); ++s) {
    lighthouse::StationCalibration station;
    station.id = simulator.stations()[s].announced.id;
    for (std::size_t rotor = 0; rotor < kAxes; ++rotor) {
      const sim::SheetErrors& e = simulator.stations()[s].announced.rotor[rotor];
      station.rotor[rotor] = {e.phase_rad, e.tilt_rad, e.curve_rad, e.gibbous_phase_rad, e.gibbous_magnitude_rad};
    }
    log.station[s] = station;
  }
  return log;
}

MeasuredLength measured(const Target& target, std::uint8_t a, std::uint8_t b, double sigma_m, double error_sigmas) {
  const double length_m = (find_sensor(target, a)->position_m - find_sensor(target, b)->position_m).norm();
  return {a, b, length_m + error_sigmas * sigma_m, sigma_m};
}

LighthouseCalibrationInput calibration_input(sim::LighthouseSimulator& simulator, std::uint64_t seed) {
  LighthouseCalibrationInput material;
  material.recordings.push_back(record(simulator));
  material.target = simulator.nominal_target();
  sim::RandomStream random(seed, "measured length");
  material.lengths.push_back(measured(simulator.true_target(), 4, 8, 0.02e-3, random.normal()));
  return material;
}

Truth compare(const LighthouseCalibration& calibration, const sim::LighthouseSimulator& simulator) {
  const BundleResult& bundle = calibration.bundle;
  const Target& nominal = simulator.nominal_target();
  const auto n = static_cast<Eigen::Index>(nominal.size());
  const auto rotors = static_cast<Eigen::Index>(simulator.stations().size() * kAxes * kRotorParameters);
  Truth out;
  Eigen::VectorXd error = Eigen::VectorXd::Zero(3 * n + rotors);
  Vector3 middle = Vector3::Zero();
  Vector3 built_middle = Vector3::Zero(), found_middle = Vector3::Zero();
  for (std::size_t k = 0; k < nominal.size(); ++k) {
    middle += nominal[k].position_m / static_cast<double>(n);
    built_middle += simulator.true_target()[k].position_m / static_cast<double>(n);
    found_middle += bundle.unknowns.target[k].position_m / static_cast<double>(n);
  }
  Matrix3 C = Matrix3::Zero();
  const auto built = [&](std::size_t k) { return Vector3(simulator.true_target()[k].position_m - built_middle); };
  const auto found = [&](std::size_t k) { return Vector3(bundle.unknowns.target[k].position_m - found_middle); };
  for (std::size_t k = 0; k < nominal.size(); ++k) C += found(k) * built(k).transpose();
  // The true body frame is rotated by milliradians relative to the nominal one: too much for a linear comparison.
  const Matrix3 R_found_built = host::nearest_rotation(C).R;
  Eigen::MatrixXd motions(3 * n, 6);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    error.segment<3>(3 * i) = found(k) - R_found_built * built(k);
    motions.block<3, 3>(3 * i, 0) = Matrix3::Identity();
    motions.block<3, 3>(3 * i, 3) = -skew(nominal[k].position_m - middle);
  }
  // Of its columns the first six span the rigid motions, the others every change of shape.
  const Eigen::MatrixXd q = Eigen::HouseholderQR<Eigen::MatrixXd>(motions).householderQ();
  const Eigen::VectorXd moved = q.leftCols(6).transpose() * error.head(3 * n);
  error.head(3 * n) -= q.leftCols(6) * moved;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double size = error.segment<3>(3 * i).norm();
    out.shape_rms_m += size * size / static_cast<double>(n);
    out.shape_worst_m = std::max(out.shape_worst_m, size);
  }
  out.shape_rms_m = std::sqrt(out.shape_rms_m);
  Eigen::Index at = 3 * n;
  for (const lighthouse::StationCalibration& station : bundle.unknowns.station) {
    for (const sim::SimulatedStation& simulated : simulator.stations()) {
      if (simulated.announced.id != station.id) continue;
      for (std::size_t axis = 0; axis < kAxes; ++axis) {
        const sim::SheetErrors& e = simulated.true_errors[axis];
        const RotorParameters estimate = parameters_of(station.rotor[axis]);
        const RotorParameters truth = {e.phase_rad, e.tilt_rad, e.curve_rad, e.gibbous_phase_rad,
                                       e.gibbous_magnitude_rad};
        for (std::size_t k = 0; k < kRotorParameters; ++k) error[at++] = estimate[k] - truth[k];
        out.phase_worst_rad = std::max(out.phase_worst_rad, std::abs(estimate[0] - truth[0]));
      }
    }
  }
  // Basis of the compared space: every change of shape that is not a rigid motion, and every rotor parameter.
  const Eigen::Index all = 3 * n + rotors;
  const Eigen::MatrixXd covariance = bundle.covariance.topLeftCorner(all, all);
  Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(all, all - 6);
  basis.topLeftCorner(3 * n, 3 * n - 6) = q.rightCols(3 * n - 6);
  basis.bottomRightCorner(rotors, rotors).setIdentity();
  out.nees_shape = nees_of(covariance, error, basis.leftCols(3 * n - 6));
  out.nees_rotors = nees_of(covariance, error, basis.rightCols(rotors));
  out.nees = nees_of(covariance, error, basis);
  out.freedom = static_cast<int>(basis.cols());
  return out;
}

}  // namespace pharos::calibrate::test
