// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/mounting/mounting_adjustment.hpp"

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <memory>

#include "host/calibrate/mounting/mounting_cost.hpp"

namespace pharos::calibrate {
namespace {

constexpr double kHuber = 4.5;  // of six residuals of unit variance: 99.7 % are within
constexpr int kMaxSteps = 30;
// Weak, so that a gap in all sources leaves no control point free: a thousand times what targets do.
constexpr double kAcceleration_m_s2 = 5.0, kAngularAcceleration_rad_s2 = 5.0;
constexpr double kMinVariance = 1e-18;

// Derivatives in five passes of ten: all fifty at once compile to several megabytes of unrolled loops.
using RowFunction = ceres::DynamicAutoDiffCostFunction<RowCost, 10>;

ceres::CostFunction* function_of(const RowCost& cost) {
  auto* function = new RowFunction(new RowCost(cost));
  for (const int size : RowCost::kSizes) function->AddParameterBlock(size);
  function->SetNumResiduals(6);
  return function;
}

// delta + base against the prior, whitened.
struct PosePrior {
  UnknownPose base, prior;
  Matrix6 whitening;
  template <class T>
  bool operator()(const T* delta, T* residual) const {
    const PoseOf<T> pose = moved<T>(base.R, base.t, delta);
    Eigen::Matrix<T, 6, 1> error;
    error << log_of<T>(pose.R * prior.R.transpose().cast<T>()), pose.t - prior.t.cast<T>();
    (Eigen::Map<Eigen::Matrix<T, 6, 1>>(residual)) = whitening.cast<T>() * error;
    return true;
  }
};

struct NumberPrior {
  double mean, sigma;
  template <class T>
  bool operator()(const T* value, T* residual) const {
    residual[0] = (value[0] - mean) / sigma;
    return true;
  }
};

// First-order Gauss-Markov: b1 = kept b0 + innovation.
struct SlowStep {
  double kept, rotation_rad, position_m;
  template <class T>
  bool operator()(const T* b0, const T* b1, T* residual) const {
    for (int i = 0; i < 6; ++i) residual[i] = (b1[i] - kept * b0[i]) / (i < 3 ? rotation_rad : position_m);
    return true;
  }
};

struct Smoothness {
  std::array<UnknownPose, 3> control;
  double rotation_rad, position_m;
  template <class T>
  bool operator()(const T* a, const T* b, const T* c, T* residual) const {
    const PoseOf<T> p0 = moved<T>(control[0].R, control[0].t, a), p1 = moved<T>(control[1].R, control[1].t, b),
                    p2 = moved<T>(control[2].R, control[2].t, c);
    const VectorOf<T> turn = log_of<T>(p2.R * p1.R.transpose()) - log_of<T>(p1.R * p0.R.transpose());
    const VectorOf<T> bend = p2.t - 2.0 * p1.t + p0.t;
    for (int i = 0; i < 3; ++i) {
      residual[i] = turn[i] / rotation_rad;
      residual[3 + i] = bend[i] / position_m;
    }
    return true;
  }
};

Matrix6 whitening_of(const Matrix6& covariance) {
  Matrix6 floored = covariance;
  floored.diagonal().array() += kMinVariance;
  return Eigen::LLT<Matrix6>(floored).matrixL().solve(Matrix6::Identity());
}

// Of a pose without turn: of the two rotations across its axis and the position; the sixth residual is always zero.
Matrix6 row_whitening(const host::SourceRow& row, double enlarged) {
  if (row.has_turn) return whitening_of(enlarged * row.covariance);
  Eigen::Matrix<double, 5, 6> pick = Eigen::Matrix<double, 5, 6>::Zero();
  pick.block<2, 3>(0, 0) = row.pose.R.leftCols<2>().transpose();
  pick.block<3, 3>(2, 3) = Matrix3::Identity();
  Matrix6 covariance = Matrix6::Identity();
  covariance.topLeftCorner<5, 5>() = enlarged * pick * row.covariance * pick.transpose();
  return whitening_of(covariance);
}

RowCost cost_of(const MountingCalibrationInput& input, const UsedRow& used, const MountingUnknowns& unknowns,
                double enlarged) {
  const host::SourceRow& row = input.recordings[used.source].rows[used.row];
  const UnknownSource& source = unknowns.sources[used.source];
  RowCost cost;
  for (std::size_t i = 0; i < 4; ++i) cost.control[i] = unknowns.motion[used.segment + i];
  cost.sensor = source.sensor;
  cost.feature = source.feature;
  cost.time_s = row.time_s;
  cost.segment_begin_s = unknowns.begin_s + static_cast<double>(used.segment) * unknowns.knot_s;
  cost.knot_s = unknowns.knot_s;
  cost.slow_begin_s = unknowns.begin_s + static_cast<double>(used.slow) * unknowns.slow_step_s;
  cost.slow_step_s = unknowns.slow_step_s;
  cost.measured = row.pose;
  cost.has_turn = row.has_turn;
  cost.whitening = row_whitening(row, enlarged);
  return cost;
}

std::vector<double*> blocks_of(const UsedRow& used, MountingUnknowns& unknowns) {
  UnknownSource& source = unknowns.sources[used.source];
  std::vector<double*> blocks;
  for (std::size_t i = 0; i < 4; ++i) blocks.push_back(unknowns.motion[used.segment + i].delta.data());
  blocks.push_back(source.sensor.delta.data());
  blocks.push_back(source.feature.delta.data());
  blocks.push_back(&source.time_offset_s);
  blocks.push_back(source.slow[used.slow].data());
  blocks.push_back(source.slow[used.slow + 1].data());
  blocks.push_back(&source.scale);
  return blocks;
}

void add_priors(const MountingCalibrationInput& input, std::size_t index, MountingUnknowns& unknowns,
                ceres::Problem& problem) {
  UnknownSource& source = unknowns.sources[index];
  const MountingRecording& recording = input.recordings[index];
  const double kept = std::exp(-unknowns.slow_step_s / input.slow_time_constant_s);
  const double step = std::sqrt(1.0 - kept * kept);
  for (std::size_t i = 0; i < source.slow.size(); ++i) {
    const double ratio = i == 0 ? 1.0 : step;
    auto* cost = new ceres::AutoDiffCostFunction<SlowStep, 6, 6, 6>(
        new SlowStep{i == 0 ? 0.0 : kept, ratio * recording.slow_rotation_rad, ratio * recording.slow_position_m});
    // The first node has no one before it: kept is 0, so that any other may stand there.
    problem.AddResidualBlock(cost, nullptr, source.slow[i == 0 ? 1 : i - 1].data(), source.slow[i].data());
  }
  if (source.scale_sigma > 0.0) {
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<NumberPrior, 1, 1>(new NumberPrior{0.0, source.scale_sigma}), nullptr,
        &source.scale);
  } else {
    problem.SetParameterBlockConstant(&source.scale);
  }
  if (source.fixed) {
    problem.SetParameterBlockConstant(source.sensor.delta.data());
    problem.SetParameterBlockConstant(source.feature.delta.data());
    problem.SetParameterBlockConstant(&source.time_offset_s);
    return;
  }
  const auto add_pose = [&](UnknownPose& pose, const UnknownPose& prior, const Matrix6& covariance) {
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<PosePrior, 6, 6>(new PosePrior{pose, prior, whitening_of(covariance)}), nullptr,
        pose.delta.data());
  };
  add_pose(source.sensor, source.prior_sensor, source.prior_sensor_covariance);
  add_pose(source.feature, source.prior_feature, source.prior_feature_covariance);
  problem.AddResidualBlock(new ceres::AutoDiffCostFunction<NumberPrior, 1, 1>(
                               new NumberPrior{source.prior_offset_s, source.prior_offset_sigma_s}),
                           nullptr, &source.time_offset_s);
}

void build(const MountingCalibrationInput& input, const std::vector<UsedRow>& rows, const std::vector<double>& enlarged,
           MountingUnknowns& unknowns, ceres::LossFunction* loss, ceres::Problem& problem) {
  for (const UsedRow& used : rows) {
    problem.AddResidualBlock(function_of(cost_of(input, used, unknowns, enlarged[used.source])), loss,
                             blocks_of(used, unknowns));
  }
  const double h2 = unknowns.knot_s * unknowns.knot_s;
  for (std::size_t i = 0; i + 2 < unknowns.motion.size(); ++i) {
    auto* smooth = new Smoothness{{unknowns.motion[i], unknowns.motion[i + 1], unknowns.motion[i + 2]},
                                  kAngularAcceleration_rad_s2 * h2,
                                  kAcceleration_m_s2 * h2};
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<Smoothness, 6, 6, 6, 6>(smooth), nullptr,
                             unknowns.motion[i].delta.data(), unknowns.motion[i + 1].delta.data(),
                             unknowns.motion[i + 2].delta.data());
  }
  for (std::size_t i = 0; i < unknowns.sources.size(); ++i) add_priors(input, i, unknowns, problem);
}

ceres::Problem::Options borrowing() {
  ceres::Problem::Options options;
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  return options;
}

// Columns of the covariance of all unknowns, (J^T J)^-1 at their present values.
class Posterior {
 public:
  Posterior(const MountingCalibrationInput& input, const std::vector<UsedRow>& rows,
            const std::vector<double>& enlarged, MountingUnknowns& unknowns)
      : loss_(kHuber), problem_(borrowing()) {
    build(input, rows, enlarged, unknowns, &loss_, problem_);
  }

  /// The place of an unknown in the order of the calls; constant ones have none.
  Eigen::Index add(double* block, Eigen::Index size) {
    const Eigen::Index at = order_;
    if (!problem_.HasParameterBlock(block) || problem_.IsParameterBlockConstant(block)) return at;
    options_.parameter_blocks.push_back(block);
    order_ += size;
    return at;
  }
  Eigen::Index order() const { return order_; }

  /// The first `wanted` columns, once all unknowns are added. `step`: where not null, by how much the unknowns are from
  /// the minimum, as far as the problem is linear.
  Eigen::MatrixXd columns(Eigen::Index wanted, Eigen::VectorXd* step = nullptr) {
    ceres::CRSMatrix jacobian;
    std::vector<double> gradient;
    problem_.Evaluate(options_, nullptr, nullptr, &gradient, &jacobian);
    const Eigen::Map<const Eigen::SparseMatrix<double, Eigen::RowMajor>> J(
        jacobian.num_rows, jacobian.num_cols, static_cast<Eigen::Index>(jacobian.values.size()), jacobian.rows.data(),
        jacobian.cols.data(), jacobian.values.data());
    const Eigen::SparseMatrix<double> information = J.transpose() * J;
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(information);
    Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(order_, wanted);
    unit.topRows(wanted).setIdentity();
    if (step != nullptr) {
      const Eigen::VectorXd downhill = -Eigen::Map<const Eigen::VectorXd>(gradient.data(), order_);
      *step = factor.solve(downhill);
    }
    return factor.solve(unit);
  }

 private:
  ceres::HuberLoss loss_;
  ceres::Problem problem_;
  ceres::Problem::EvaluateOptions options_;
  Eigen::Index order_ = 0;
};

}  // namespace

std::vector<UsedRow> select_rows(const MountingCalibrationInput& input, const MountingUnknowns& unknowns,
                                 const std::vector<std::vector<bool>>& usable) {
  std::vector<UsedRow> rows;
  for (std::size_t s = 0; s < input.recordings.size(); ++s) {
    const std::vector<host::SourceRow>& all = input.recordings[s].rows;
    for (std::size_t r = 0; r < all.size(); ++r) {
      if (!usable[s][r]) continue;
      const double since_s = all[r].time_s + unknowns.sources[s].time_offset_s - unknowns.begin_s;
      const double at = since_s / unknowns.knot_s;
      if (at < 0.0 || at > static_cast<double>(unknowns.segments())) continue;
      const auto slow = static_cast<std::size_t>(since_s / unknowns.slow_step_s);
      rows.push_back({s, r, std::min(static_cast<std::size_t>(at), unknowns.segments() - 1),
                      std::min(slow, unknowns.sources[s].slow.size() - 2)});
    }
  }
  return rows;
}

bool adjust(const MountingCalibrationInput& input, const std::vector<UsedRow>& rows,
            const std::vector<double>& enlarged, MountingUnknowns& unknowns) {
  ceres::HuberLoss loss(kHuber);
  ceres::Problem problem(borrowing());
  build(input, rows, enlarged, unknowns, &loss, problem);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.max_num_iterations = kMaxSteps;
  options.function_tolerance = 1e-8;
  options.logging_type = ceres::SILENT;
  options.num_threads = 1;  // identical results in every run
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  for (UnknownPose& pose : unknowns.motion) pose.settle();
  for (UnknownSource& source : unknowns.sources) {
    source.sensor.settle();
    source.feature.settle();
  }
  return summary.termination_type == ceres::CONVERGENCE;
}

std::vector<SourceCovariance> covariances(const MountingCalibrationInput& input, const std::vector<UsedRow>& rows,
                                          const std::vector<double>& enlarged, MountingUnknowns& unknowns) {
  Posterior posterior(input, rows, enlarged, unknowns);
  std::vector<Eigen::Index> at(unknowns.sources.size(), -1);
  for (std::size_t s = 0; s < unknowns.sources.size(); ++s) {
    UnknownSource& source = unknowns.sources[s];
    if (source.fixed) continue;
    at[s] = posterior.add(source.sensor.delta.data(), 6);
    posterior.add(source.feature.delta.data(), 6);
    posterior.add(&source.time_offset_s, 1);
  }
  const Eigen::Index wanted = posterior.order();
  for (UnknownSource& source : unknowns.sources) {
    for (auto& node : source.slow) posterior.add(node.data(), 6);
    posterior.add(&source.scale, 1);
  }
  for (UnknownPose& pose : unknowns.motion) posterior.add(pose.delta.data(), 6);
  const Eigen::MatrixXd columns = posterior.columns(wanted);
  std::vector<SourceCovariance> out(unknowns.sources.size(), SourceCovariance::Zero());
  for (std::size_t s = 0; s < out.size(); ++s) {
    if (at[s] < 0) continue;
    const SourceCovariance block = columns.block<13, 13>(at[s], at[s]);
    out[s] = 0.5 * (block + block.transpose());
  }
  return out;
}

std::vector<SlowEvidence> slow_evidence(const MountingCalibrationInput& input, const std::vector<UsedRow>& rows,
                                        const std::vector<double>& enlarged, MountingUnknowns& unknowns) {
  Posterior posterior(input, rows, enlarged, unknowns);
  for (UnknownSource& source : unknowns.sources) {
    for (auto& node : source.slow) posterior.add(node.data(), 6);
  }
  const Eigen::Index wanted = posterior.order();
  for (UnknownSource& source : unknowns.sources) {
    posterior.add(source.sensor.delta.data(), 6);
    posterior.add(source.feature.delta.data(), 6);
    posterior.add(&source.time_offset_s, 1);
    posterior.add(&source.scale, 1);
  }
  for (UnknownPose& pose : unknowns.motion) posterior.add(pose.delta.data(), 6);
  Eigen::VectorXd step;
  const Eigen::MatrixXd covariance = posterior.columns(wanted, &step);
  const double kept = std::exp(-unknowns.slow_step_s / input.slow_time_constant_s);
  std::vector<SlowEvidence> out(unknowns.sources.size());
  Eigen::Index first = 0;
  for (std::size_t s = 0; s < out.size(); ++s) {
    const std::vector<std::array<double, 6>>& nodes = unknowns.sources[s].slow;
    const MountingRecording& recording = input.recordings[s];
    for (int axis = 0; axis < 6; ++axis) {
      const double sigma = axis < 3 ? recording.slow_rotation_rad : recording.slow_position_m;
      SlowEvidence& sum = out[s];
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        // Innovation of the process: the node alone, or less what is kept of the one before.
        const Eigen::Index at = first + 6 * static_cast<Eigen::Index>(i) + axis;
        double mean = nodes[i][static_cast<std::size_t>(axis)] + step[at];
        double variance = covariance(at, at);
        if (i > 0) {
          mean -= kept * (nodes[i - 1][static_cast<std::size_t>(axis)] + step[at - 6]);
          variance += kept * kept * covariance(at - 6, at - 6) - 2.0 * kept * covariance(at, at - 6);
        }
        const double scale = i > 0 ? 1.0 - kept * kept : 1.0;
        (axis < 3 ? sum.rotation_rad2 : sum.position_m2) += mean * mean / scale;
        (axis < 3 ? sum.rotation_freedom : sum.position_freedom) += 1.0 - variance / (scale * sigma * sigma);
      }
    }
    first += 6 * static_cast<Eigen::Index>(nodes.size());
  }
  return out;
}

RowResidual residual_of(const MountingCalibrationInput& input, const UsedRow& row, const MountingUnknowns& unknowns) {
  const RowCost cost = cost_of(input, row, unknowns, 1.0);
  MountingUnknowns& read = const_cast<MountingUnknowns&>(unknowns);
  const std::vector<double*> blocks = blocks_of(row, read);
  const std::vector<const double*> p(blocks.begin(), blocks.end());
  RowResidual out;
  out.time_s = cost.time_s + unknowns.sources[row.source].time_offset_s;
  cost.errors<double>(p.data(), out.rotation_rad, out.position_m);
  Vector6 whitened;
  cost(p.data(), whitened.data());
  out.chi2 = whitened.squaredNorm();
  return out;
}

}  // namespace pharos::calibrate
