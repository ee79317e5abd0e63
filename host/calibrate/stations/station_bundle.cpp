// SPDX-License-Identifier: Apache-2.0
// The only file of the stations' calibration that includes Ceres' solver, whose headers take long to compile.
#include "host/calibrate/stations/station_bundle.hpp"

#include <ceres/loss_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "host/calibrate/cost_functions.hpp"
#include "host/calibrate/stations/sweep_cost.hpp"

namespace pharos::calibrate {
namespace {

constexpr double kLossSigmas = 3.0;
// Of the cost, relative. Attitudes that light from aside tells are hardly known: the last steps go far for little, and
// before the optimum the scatter of the pieces is no covariance (scale 3 % where 0.7 % are known).
constexpr double kConverged = 1e-9;
constexpr double kGrazing = 0.1;  // cosine of the incidence below which a sensor is hardly lit

// Light from aside meets a sensor elsewhere: in proportion to the tangent of the incidence by its height, which is
// adjusted, and beyond that by what its cover and its surroundings do, in the tangent's square and as far as its place
// is unknown anyway. Returns the angle that a metre of that is, rad/m, RMS over the hits.
double aside_per_m(const network::PlaneSweep& sweep, const Target& target, const network::WorldFromBody& body,
                   const Vector3& station_m) {
  const Vector3 from_m = body.inverse() * station_m;
  double square = 0.0;
  for (const network::Hit& hit : sweep.hits) {
    const SensorPlacement* sensor = find_sensor(target, hit.sensor);
    if (!sensor->has_normal()) continue;
    const Vector3 ray_m = from_m - sensor->position_m;
    const double cosine = std::max(kGrazing, sensor->normal.dot(ray_m) / ray_m.norm());
    square += std::pow((1.0 / (cosine * cosine) - 1.0) / ray_m.norm(), 2);
  }
  return std::sqrt(square / static_cast<double>(sweep.hits.size()));
}

// One adjustment. Ceres keeps the blocks' addresses: not to be moved.
class Adjustment {
 public:
  Adjustment(const StationUnknowns& start, const network::Stations& prior, const Target& nominal,
             const std::vector<UsedSweep>& sweeps, const NetworkNoise& noise, const StationBundleOptions& options)
      : at_(start), noise_(noise), options_(options), rows_of_piece_(start.motion.size()) {
    station_delta_.assign(at_.stations.size(), {});
    for (const network::Station& station : at_.stations) {
      plane_.push_back({fields_of(station.plane[0]), fields_of(station.plane[1])});
    }
    for (const SensorPlacement& sensor : at_.target) {
      sensor_.push_back({sensor.position_m.x(), sensor.position_m.y(), sensor.position_m.z()});
    }
    for (const UsedSweep& used : sweeps) add_sweep(used);
    for (BodySpline& motion : at_.motion) add_motion(motion);
    add_priors(prior, nominal);
  }

  bool solve() {
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
    options.max_num_iterations = options_.max_steps;
    options.function_tolerance = kConverged;
    options.logging_type = ceres::SILENT;
    options.num_threads = 1;  // identical results in every run
    ceres::Solver::Summary summary;
    ceres::Solve(options, &ceres_, &summary);
    return summary.termination_type == ceres::CONVERGENCE;
  }

  StationUnknowns unknowns() const {
    StationUnknowns out = at_;
    for (std::size_t s = 0; s < out.stations.size(); ++s) {
      network::Station& station = out.stations[s];
      station.T_world_station = station.T_world_station->moved_by(Eigen::Map<const Vector6>(station_delta_[s].data()));
      for (std::size_t k = 0; k < network::kPlanes; ++k) station.plane[k] = plane_of(plane_[s][k]);
    }
    for (std::size_t i = 0; i < sensor_.size(); ++i) {
      out.target[i].position_m = Eigen::Map<const Vector3>(sensor_[i].data());
    }
    for (BodySpline& motion : out.motion) motion.rebase();
    return out;
  }

  Eigen::MatrixXd covariance() {
    ceres::Problem::EvaluateOptions options;
    const auto n = static_cast<Eigen::Index>(order(options.parameter_blocks));
    const Eigen::SparseMatrix<double> J = jacobian(options);
    const Eigen::SparseMatrix<double> H = J.transpose() * J;
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(H);
    Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(H.cols(), n);
    unit.bottomRows(n).setIdentity();
    const Eigen::MatrixXd noise = Eigen::MatrixXd(factor.solve(unit)).bottomRows(n);
    Eigen::MatrixXd scattered = noise * scatter(options, n, field_variance(noise)) * noise;
    for (Eigen::Index k = 0; k < n; ++k) {
      const double more = std::sqrt(std::max(1.0, noise(k, k) / std::max(1e-300, scattered(k, k))));
      scattered.row(k) *= more;
      scattered.col(k) *= more;
    }
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(n + 6, n + 6);
    out.bottomRightCorner(n, n) = scattered;
    return out;
  }

 private:
  Eigen::SparseMatrix<double> jacobian(const ceres::Problem::EvaluateOptions& options) {
    ceres::CRSMatrix crs;
    ceres_.Evaluate(options, nullptr, nullptr, nullptr, &crs);
    using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor>;
    return Eigen::Map<const Rows>(crs.num_rows, crs.num_cols, crs.rows.back(), crs.rows.data(), crs.cols.data(),
                                  crs.values.data());
  }

  // What is between bread of a sandwich estimator: the sum over the pieces of g g^T, g the piece's gradient by what is
  // calibrated (that by its motion is zero at the optimum), and of the priors what they are expected to be: those of
  // the fields `field_variance` times.
  Eigen::MatrixXd scatter(ceres::Problem::EvaluateOptions options, Eigen::Index n, double field_variance) {
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(n, n);
    for (const auto& rows : rows_of_piece_) {
      options.residual_blocks = rows;
      if (rows.empty()) continue;
      std::vector<double> gradient;
      ceres_.Evaluate(options, nullptr, nullptr, &gradient, nullptr);
      const Eigen::VectorXd g = Eigen::Map<const Eigen::VectorXd>(gradient.data(), std::ssize(gradient)).tail(n);
      sum += g * g.transpose();
    }
    const auto add_priors = [&](const std::vector<ceres::ResidualBlockId>& rows, double variance) {
      options.residual_blocks = rows;
      const Eigen::SparseMatrix<double> P = jacobian(options).rightCols(n);
      sum += variance * Eigen::MatrixXd(P.transpose() * P);
    };
    add_priors(field_rows_, field_variance);
    add_priors(sensor_rows_, 1.0);
    return sum;
  }

  // How much further than their priors say the fields lie from them: chi-squared by the degrees of freedom that the
  // light has in them (a variance component: Foerstner 1979). What no field describes pulls them there, alike in all
  // pieces, so that the scatter does not show it.
  double field_variance(const Eigen::MatrixXd& noise) {
    ceres::Problem::EvaluateOptions options;
    options.residual_blocks = field_rows_;
    std::vector<double> departures;
    ceres_.Evaluate(options, nullptr, &departures, nullptr, nullptr);
    double chi2 = 0.0, degrees = 0.0;
    Eigen::Index column = 0;
    std::size_t row = 0;
    for (std::size_t s = 0; s < plane_.size(); ++s) {
      if (s > 0) column += 6;
      for (const PlaneFields& sigmas : field_sigma_[s]) {
        for (const double sigma : sigmas) {
          chi2 += departures[row] * departures[row];
          degrees += std::max(0.0, 1.0 - noise(column, column) / (sigma * sigma));
          ++row;
          ++column;
        }
      }
    }
    return std::max(1.0, chi2 / std::max(1.0, degrees));
  }

  void add_sweep(const UsedSweep& used) {
    const network::PlaneSweep& sweep = used.sweep;
    BodySpline& motion = at_.motion[used.motion];
    const network::Station& station = at_.stations[sweep.station];
    PlaneNoise noise = noise_[sweep.station][sweep.plane];
    const auto body = motion.pose(sweep.hits[0].time_s);
    noise.apart_rad = options_.sensor_sigma_m * aside_per_m(sweep, at_.target, body, station.T_world_station->t);
    const SweepRows rows = sweep_rows(sweep, station, motion, noise);
    std::vector<double*> blocks;
    for (std::size_t k = 0; k < 4; ++k) blocks.push_back(motion.position[rows.first_control + k].data());
    for (std::size_t k = 0; k < 4; ++k) blocks.push_back(motion.turn[rows.first_control + k].data());
    blocks.push_back(station_delta_[sweep.station].data());
    blocks.push_back(plane_[sweep.station][sweep.plane].data());
    for (const network::Hit& hit : sweep.hits) {
      const SensorPlacement* sensor = find_sensor(at_.target, hit.sensor);
      blocks.push_back(sensor_[static_cast<std::size_t>(sensor - at_.target.begin())].data());
    }
    rows_of_piece_[used.motion].push_back(
        ceres_.AddResidualBlock(sweep_cost(rows), loss_of(sweep.hits.size()), blocks));
  }

  ceres::LossFunction* loss_of(std::size_t hits) {
    auto& loss = loss_[hits];
    if (!loss) loss = std::make_unique<ceres::CauchyLoss>(kLossSigmas * std::sqrt(static_cast<double>(hits)));
    return loss.get();
  }

  void add_motion(BodySpline& motion) {
    for (std::size_t i = 0; i < motion.segments(); ++i) {
      const auto add = [&](auto& control, const Vector3& offset, double density) {
        ceres_.AddResidualBlock(jerk_cost(offset, density, motion.step_s()), nullptr,
                                std::vector<double*>{control[i].data(), control[i + 1].data(), control[i + 2].data(),
                                                     control[i + 3].data()});
      };
      add(motion.position, Vector3::Zero(), options_.jerk.translation);
      // Rotation vectors of the four references in the chart of the second.
      const Vector3 offset = motion.reference_turn(i + 1, i + 3) - 3.0 * motion.reference_turn(i + 1, i + 2) -
                             motion.reference_turn(i + 1, i);
      add(motion.turn, offset, options_.jerk.rotation);
    }
  }

  void add_priors(const network::Stations& prior, const Target& nominal) {
    field_sigma_.resize(plane_.size());
    for (std::size_t s = 0; s < plane_.size(); ++s) {
      if (!ceres_.HasParameterBlock(station_delta_[s].data())) ceres_.AddParameterBlock(station_delta_[s].data(), 6);
      for (std::size_t k = 0; k < network::kPlanes; ++k) {
        const PlaneFields mean = fields_of(prior[s].plane[k]);
        const PlaneFields sigma = prior_sigmas(prior[s].generation, mean);
        field_sigma_[s][k] = sigma;
        field_rows_.push_back(prior_row({mean.begin(), mean.end()}, {sigma.begin(), sigma.end()}, plane_[s][k].data()));
      }
    }
    ceres_.SetParameterBlockConstant(station_delta_[0].data());
    for (std::size_t i = 0; i < sensor_.size(); ++i) {
      const Vector3& p = nominal[i].position_m;
      sensor_rows_.push_back(
          prior_row({p.x(), p.y(), p.z()}, std::vector<double>(3, options_.sensor_sigma_m), sensor_[i].data()));
    }
  }

  ceres::ResidualBlockId prior_row(const std::vector<double>& mean, const std::vector<double>& sigma, double* block) {
    return ceres_.AddResidualBlock(prior_cost(mean, sigma), nullptr, block);
  }

  // Motion first, what is calibrated last; returns how many of the latter, without the first station's pose.
  std::size_t order(std::vector<double*>& blocks) {
    for (BodySpline& motion : at_.motion) {
      for (auto& control : motion.position) blocks.push_back(control.data());
      for (auto& control : motion.turn) blocks.push_back(control.data());
    }
    std::size_t calibrated = 0;
    for (std::size_t s = 0; s < plane_.size(); ++s) {
      if (s > 0) blocks.push_back(station_delta_[s].data());
      for (PlaneFields& plane : plane_[s]) blocks.push_back(plane.data());
      calibrated += (s > 0 ? 6U : 0U) + network::kPlanes * kPlaneFields;
    }
    for (auto& sensor : sensor_) blocks.push_back(sensor.data());
    return calibrated + 3 * sensor_.size();
  }

  StationUnknowns at_;
  const NetworkNoise& noise_;
  const StationBundleOptions& options_;
  std::vector<std::array<double, 6>> station_delta_;
  std::vector<std::array<PlaneFields, network::kPlanes>> plane_;
  std::vector<std::array<double, 3>> sensor_;
  std::vector<std::vector<ceres::ResidualBlockId>> rows_of_piece_;
  std::vector<ceres::ResidualBlockId> field_rows_, sensor_rows_;  // of the priors
  std::vector<std::array<PlaneFields, network::kPlanes>> field_sigma_;
  std::map<std::size_t, std::unique_ptr<ceres::LossFunction>> loss_;
  ceres::Problem ceres_{[] {
    ceres::Problem::Options options;
    options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    return options;
  }()};
};

}  // namespace

SweepResiduals residuals_of(const network::PlaneSweep& sweep, const BodySpline& motion,
                            const StationUnknowns& unknowns) {
  const network::Station& station = unknowns.stations[sweep.station];
  const auto T_station_world = station.T_world_station->inverse();
  SweepResiduals out;
  for (const network::Hit& hit : sweep.hits) {
    const SensorPlacement* sensor = find_sensor(unknowns.target, hit.sensor);
    const Vector3 p = T_station_world * (motion.pose(hit.time_s) * sensor->position_m);
    out.push_back(hit.angle_rad - network::raw_angle(station, sweep.plane, p));
  }
  return out;
}

StationBundleResult adjust_stations(const StationUnknowns& start, const network::Stations& prior, const Target& nominal,
                                    const std::vector<UsedSweep>& sweeps, const NetworkNoise& noise,
                                    const StationBundleOptions& options, bool with_covariance) {
  Adjustment adjustment(start, prior, nominal, sweeps, noise, options);
  StationBundleResult out;
  out.converged = adjustment.solve();
  if (with_covariance) out.covariance = adjustment.covariance();
  out.unknowns = adjustment.unknowns();
  for (const UsedSweep& used : sweeps) {
    out.residuals.push_back(residuals_of(used.sweep, out.unknowns.motion[used.motion], out.unknowns));
  }
  return out;
}

}  // namespace pharos::calibrate
