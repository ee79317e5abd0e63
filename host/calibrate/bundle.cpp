// SPDX-License-Identifier: Apache-2.0
// The only file of the Lighthouse calibration that includes Ceres' solver, whose headers take long to compile.
#include "host/calibrate/bundle.hpp"

#include <ceres/loss_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <cmath>
#include <memory>

#include "host/calibrate/cost_functions.hpp"
#include "host/calibrate/observability.hpp"
#include "host/calibrate/parameter_blocks.hpp"

namespace pharos::calibrate {
namespace {

constexpr double kHuber = 3.0;
constexpr int kMaxSteps = 60;

// One adjustment: its rows and their meaning.
class Adjustment {
 public:
  explicit Adjustment(const BundleProblem& problem) : problem_(problem), blocks_(problem) {
    add_priors();
    add_frame();
    for (const MeasuredLength& length : problem.lengths) add_length(length);
    for (std::size_t i = 0; i < problem.intervals->size(); ++i) add_interval(i);
  }

  bool solve() {
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
    options.max_num_iterations = kMaxSteps;
    options.function_tolerance = 1e-12;
    options.parameter_tolerance = 1e-12;
    options.logging_type = ceres::SILENT;
    options.num_threads = 1;  // identical results in every run
    ceres::Solver::Summary summary;
    ceres::Solve(options, &ceres_, &summary);
    return summary.termination_type == ceres::CONVERGENCE;
  }

  BundleResult result() {
    BundleResult out;
    out.unknowns = blocks_.unknowns(problem_);
    out.parameters = parameters_of(problem_, blocks_);
    const Linearised linear = linearise();
    const Information information(linear.jacobian, problem_, blocks_);
    information.fill(out);
    for (std::size_t i = 0; i < problem_.lengths.size(); ++i) {
      const std::size_t row = length_rows_ + i;
      out.lengths.push_back(check(problem_.lengths[i], linear.residual[row], information.leverage(row)));
    }
    for (std::size_t i = 0; i < bearings_.size(); ++i) {
      BearingResidual residual = bearings_[i];
      residual.residual_rad = linear.residual[bearing_rows_[i]] * residual.sigma_rad;
      residual.leverage = information.leverage(bearing_rows_[i]);
      out.residuals.push_back(residual);
    }
    return out;
  }

 private:
  struct Linearised {
    SparseRows jacobian;  // whitened, after the loss
    std::vector<double> residual;
  };

  void add_row(ceres::CostFunction* cost, ceres::LossFunction* loss, const std::vector<double*>& parameters) {
    scalar_rows_ += static_cast<std::size_t>(cost->num_residuals());
    rows_.push_back(ceres_.AddResidualBlock(cost, loss, parameters));
  }

  void add_priors() {
    for (std::size_t i = 0; i < blocks_.sensor.size(); ++i) {
      const Vector3& p = problem_.nominal.target[i].position_m;
      add_row(prior_cost({p.x(), p.y(), p.z()}, std::vector<double>(3, problem_.sigmas.sensor_position_m)), nullptr,
              {blocks_.sensor[i].data()});
    }
    for (std::size_t s = 0; s < blocks_.rotor.size(); ++s) {
      for (std::size_t axis = 0; axis < kAxes; ++axis) {
        const RotorParameters mean = parameters_of(problem_.nominal.station[s].rotor[axis]);
        const RotorParameters& sigma = problem_.sigmas.rotor;
        add_row(prior_cost({mean.begin(), mean.end()}, {sigma.begin(), sigma.end()}), nullptr,
                {blocks_.rotor[s][axis].data()});
      }
    }
  }

  void add_frame() {
    std::vector<Vector3> nominal;
    std::vector<double*> parameters;
    for (std::size_t i = 0; i < blocks_.sensor.size(); ++i) {
      if (!blocks_.hit[i]) continue;
      nominal.push_back(problem_.nominal.target[i].position_m);
      parameters.push_back(blocks_.sensor[i].data());
    }
    add_row(frame_cost(nominal), nullptr, parameters);
    length_rows_ = scalar_rows_;
  }

  void add_length(const MeasuredLength& length) {
    add_row(length_cost(length), nullptr,
            {blocks_.sensor[index_in(problem_.nominal.target, length.a)].data(),
             blocks_.sensor[index_in(problem_.nominal.target, length.b)].data()});
  }

  void add_interval(std::size_t index) {
    const StationaryAverage& interval = (*problem_.intervals)[index];
    for (std::size_t v = 0; v < interval.rotors.size(); ++v) {
      const RotorView& view = interval.rotors[v];
      if (view.bearings.empty()) continue;
      for (std::size_t b = 0; b < view.bearings.size(); ++b) add_bearing(index, v, b);
      add_row(prior_cost({0.0}, {view.common_sigma_rad}), nullptr, {&blocks_.common[index][v]});
    }
  }

  void add_bearing(std::size_t interval, std::size_t view_index, std::size_t bearing_index) {
    const RotorView& view = (*problem_.intervals)[interval].rotors[view_index];
    const MeanBearing& bearing = view.bearings[bearing_index];
    BearingRow row;
    row.axis = view.axis;
    row.form = problem_.form;
    row.raw_rad = bearing.raw_rad;
    row.sigma_rad = std::hypot(bearing.own_sigma_rad, problem_.unmodelled_rad);
    row.T_home_body = problem_.nominal.T_home_body[interval];
    std::vector<double*> parameters = {
        blocks_.rotor[view.station][static_cast<std::size_t>(index_of(view.axis))].data(),
        blocks_.pose_delta[interval].data(), blocks_.sensor[index_in(problem_.nominal.target, bearing.sensor)].data(),
        &blocks_.common[interval][view_index]};
    if (view.station != problem_.home[interval]) {
      row.T_reference_station = problem_.nominal.T_reference_station[view.station];
      parameters.push_back(blocks_.station_delta.data());
    }
    bearings_.push_back({interval, view_index, bearing_index, 0.0, row.sigma_rad, 0.0});
    bearing_rows_.push_back(scalar_rows_);
    add_row(bearing_cost(row), &loss_, parameters);
  }

  // Calibration parameters first, so that their covariance is the upper left block.
  std::vector<double*> parameter_order() {
    std::vector<double*> order;
    for (auto& sensor : blocks_.sensor) order.push_back(sensor.data());
    for (auto& station : blocks_.rotor) {
      for (RotorParameters& rotor : station) order.push_back(rotor.data());
    }
    if (blocks_.pair) order.push_back(blocks_.station_delta.data());
    for (auto& pose : blocks_.pose_delta) order.push_back(pose.data());
    for (auto& interval : blocks_.common) {
      for (double& common : interval) {
        if (ceres_.HasParameterBlock(&common)) order.push_back(&common);
      }
    }
    return order;
  }

  Linearised linearise() {
    ceres::Problem::EvaluateOptions options;
    options.parameter_blocks = parameter_order();
    options.residual_blocks = rows_;
    ceres::CRSMatrix sparse;
    Linearised out;
    ceres_.Evaluate(options, nullptr, nullptr, nullptr, &sparse);
    options.apply_loss_function = false;
    ceres_.Evaluate(options, nullptr, &out.residual, nullptr, nullptr);
    out.jacobian = Eigen::Map<const SparseRows>(sparse.num_rows, sparse.num_cols, sparse.rows.back(),
                                                sparse.rows.data(), sparse.cols.data(), sparse.values.data());
    return out;
  }

  // With r = (fit - length) / sigma and leverage h: without this length the fit differs from it by r / (1 - h) sigmas,
  // and that difference has the variance sigma^2 h / (1 - h).
  static LengthCheck check(const MeasuredLength& length, double r, double leverage) {
    const double free = std::max(1.0 - leverage, 1e-12);
    return {length.length_m + r * length.sigma_m / free, length.sigma_m * std::sqrt(leverage / free),
            std::abs(r) / std::sqrt(free)};
  }

  const BundleProblem& problem_;
  ParameterBlocks blocks_;
  ceres::HuberLoss loss_{kHuber};
  ceres::Problem ceres_{[] {
    ceres::Problem::Options options;
    options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    return options;
  }()};
  std::vector<ceres::ResidualBlockId> rows_;
  std::size_t scalar_rows_ = 0;
  std::size_t length_rows_ = 0;
  std::vector<BearingResidual> bearings_;
  std::vector<std::size_t> bearing_rows_;
};

}  // namespace

BundleResult adjust(const BundleProblem& problem) {
  Adjustment adjustment(problem);
  const bool converged = adjustment.solve();
  BundleResult result = adjustment.result();
  result.converged = converged;
  return result;
}

}  // namespace pharos::calibrate
