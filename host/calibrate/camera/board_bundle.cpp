// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/camera/board_bundle.hpp"

#include <ceres/manifold.h>
#include <ceres/numeric_diff_cost_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <Eigen/Cholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <cmath>

#include "pharos/geometry/rotation.hpp"

namespace pharos::calibrate {
namespace {

constexpr int kMaxBundleSteps = 100;
constexpr double kConverged = 1e-12;  // relative change of the squares
constexpr int kIntrinsics = 9;        // fx, fy, cx, cy, k1, k2, p1, p2, k3
constexpr int kPose = 6;
constexpr std::array<const char*, kIntrinsics> kNames{"fx_px", "fy_px", "cx_px", "cy_px", "k1", "k2", "p1", "p2", "k3"};
constexpr std::array<const char*, kPose> kRigNames{"right.rotation_x_rad", "right.rotation_y_rad",
                                                   "right.rotation_z_rad", "right.position_x_m",
                                                   "right.position_y_m",   "right.position_z_m"};

using BundleOptics = std::array<double, kIntrinsics>;

BundleOptics optics_of(const PinholeCamera& camera) {
  const auto& d = camera.distortion;
  return {camera.fx_px, camera.fy_px, camera.cx_px, camera.cy_px, d[0], d[1], d[2], d[3], d[4]};
}

PinholeCamera camera_of(const PinholeCamera& size, const double* intrinsics) {
  return {size.width_px,
          size.height_px,
          intrinsics[0],
          intrinsics[1],
          intrinsics[2],
          intrinsics[3],
          {intrinsics[4], intrinsics[5], intrinsics[6], intrinsics[7], intrinsics[8]}};
}

CameraFromBoard pose_in(const BundleState& state, std::size_t camera, std::size_t view) {
  const CameraFromBoard& T = state.T_camera_board[view];
  return camera == 0 ? T : state.T_left_right.inverse() * T;
}

// A point of a view: found minus predicted, over its sigma. Poses are parametrised as steps (Pose::moved_by) from those
// of a state. Derivatives are numeric: those of a dot's centroid are long expressions, and their time is negligible
// beside the search for dots.
struct PointCost {
  const BundleState& state;
  const BundleData& data;
  std::size_t camera, view, point;

  bool operator()(const double* intrinsics, const double* board_step, double* residual) const {
    return compare(intrinsics, state.T_camera_board[view].moved_by(Vector6(board_step)), residual);
  }
  bool operator()(const double* intrinsics, const double* board_step, const double* rig_step, double* residual) const {
    return compare(intrinsics,
                   state.T_left_right.moved_by(Vector6(rig_step)).inverse() *
                       state.T_camera_board[view].moved_by(Vector6(board_step)),
                   residual);
  }
  bool compare(const double* intrinsics, const CameraFromBoard& T_camera_board, double* residual) const {
    const PinholeCamera lens = camera_of(state.cameras[camera], intrinsics);
    if (!is_usable(lens) || !((T_camera_board * data.board.point_m(point)).z() > data.board.radius_m)) return false;
    const FoundPoint& found = data.found[camera][view].points[point];
    Eigen::Map<Vector2> out(residual);
    out = (found.pixel - project_board_point(lens, T_camera_board, data.board, point).pixel) / found.sigma_px;
    return true;
  }
};

// The unknowns as Ceres parameter blocks, and the problem over them; parameters shared by all views come first.
class Adjustment {
 public:
  Adjustment(BundleState state, const BundleData& data)
      : state_(std::move(state)), data_(data), boards_(state_.T_camera_board.size(), Vector6::Zero()) {
    for (PinholeCamera& camera : state_.cameras) {
      if (data.fix_k3) camera.distortion[4] = 0.0;
      optics_.push_back(optics_of(camera));
    }
    for (std::size_t camera = 0; camera < optics_.size(); ++camera) {
      for (std::size_t view = 0; view < boards_.size(); ++view) {
        for (std::size_t point = 0; point < data.board.size(); ++point) add({state_, data, camera, view, point});
      }
      // NOLINTNEXTLINE(cppcoreguidelines-owning-memory): the problem owns it
      if (data.fix_k3)
        ceres_.SetManifold(optics_[camera].data(), new ceres::SubsetManifold(kIntrinsics, {kIntrinsics - 1}));
    }
  }

  bool solve() {
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_SCHUR;
    options.linear_solver_ordering = std::make_shared<ceres::ParameterBlockOrdering>();
    for (double* block : blocks()) options.linear_solver_ordering->AddElementToGroup(block, 1);
    for (Vector6& board : boards_)
      options.linear_solver_ordering->AddElementToGroup(board.data(), 0);  // eliminated first
    options.max_num_iterations = kMaxBundleSteps;
    options.function_tolerance = kConverged;
    options.gradient_tolerance = 0.0;
    options.parameter_tolerance = 0.0;
    options.logging_type = ceres::SILENT;
    options.num_threads = 1;  // identical results in every run
    ceres::Solver::Summary summary;
    ceres::Solve(options, &ceres_, &summary);
    if (summary.IsSolutionUsable()) take_steps();
    return summary.IsSolutionUsable();
  }

  // Covariance and noise of the present state.
  std::optional<BundleOutcome> outcome() {
    ceres::Problem::EvaluateOptions options;
    options.parameter_blocks = blocks();
    ceres::CRSMatrix sparse;
    double cost = 0.0;
    ceres_.Evaluate(options, &cost, nullptr, nullptr, &sparse);
    if (sparse.num_rows <= sparse.num_cols) return std::nullopt;
    const Eigen::Map<const Eigen::SparseMatrix<double, Eigen::RowMajor>> J(sparse.num_rows, sparse.num_cols,
                                                                           sparse.rows.back(), sparse.rows.data(),
                                                                           sparse.cols.data(), sparse.values.data());
    // Scaled to a unit diagonal: pixels, metres and radians differ by orders of magnitude.
    Eigen::MatrixXd normal = Eigen::SparseMatrix<double>(J.transpose() * J);
    const Eigen::VectorXd scale = normal.diagonal().cwiseSqrt().cwiseInverse();
    normal = scale.asDiagonal() * normal * scale.asDiagonal();
    const auto factors = normal.ldlt();
    if (factors.info() != Eigen::Success || !factors.isPositive()) return std::nullopt;
    BundleOutcome outcome;
    outcome.parameters = names();
    const auto shared = static_cast<Eigen::Index>(outcome.parameters.size());
    const Eigen::MatrixXd inverse = factors.solve(Eigen::MatrixXd::Identity(normal.rows(), shared)).topRows(shared);
    const double variance = 2.0 * cost / (sparse.num_rows - sparse.num_cols);
    outcome.covariance = variance * scale.head(shared).asDiagonal() * inverse * scale.head(shared).asDiagonal();
    if (!outcome.covariance.allFinite() || !(outcome.covariance.diagonal().minCoeff() > 0.0)) return std::nullopt;
    outcome.noise_ratio = std::sqrt(variance);
    outcome.state = state_;
    return outcome;
  }

 private:
  void add(const PointCost& point) {
    using ceres::NumericDiffCostFunction;
    double *intrinsics = optics_[point.camera].data(), *board = boards_[point.view].data();
    // NOLINTBEGIN(cppcoreguidelines-owning-memory): the problem owns them
    if (point.camera == 0) {
      using Cost = NumericDiffCostFunction<PointCost, ceres::FORWARD, 2, kIntrinsics, kPose>;
      ceres_.AddResidualBlock(new Cost(new PointCost(point)), nullptr, intrinsics, board);
    } else {
      using Cost = NumericDiffCostFunction<PointCost, ceres::FORWARD, 2, kIntrinsics, kPose, kPose>;
      ceres_.AddResidualBlock(new Cost(new PointCost(point)), nullptr, intrinsics, board, rig_.data());
    }
    // NOLINTEND(cppcoreguidelines-owning-memory)
  }

  std::vector<double*> blocks() {
    std::vector<double*> blocks;
    for (BundleOptics& intrinsics : optics_) blocks.push_back(intrinsics.data());
    if (optics_.size() > 1) blocks.push_back(rig_.data());
    for (Vector6& board : boards_) blocks.push_back(board.data());
    return blocks;
  }

  // Applies the steps to the state and sets them to zero, where their derivatives are those of moved_by.
  void take_steps() {
    for (std::size_t camera = 0; camera < optics_.size(); ++camera) {
      state_.cameras[camera] = camera_of(state_.cameras[camera], optics_[camera].data());
    }
    const auto take = [](auto& pose, Vector6& step) {
      pose = pose.moved_by(step);
      pose.R = orthonormalised(pose.R);
      step.setZero();
    };
    take(state_.T_left_right, rig_);
    for (std::size_t view = 0; view < boards_.size(); ++view) take(state_.T_camera_board[view], boards_[view]);
  }

  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (std::size_t camera = 0; camera < optics_.size(); ++camera) {
      const std::string whose = optics_.size() == 1 ? "" : camera == 0 ? "left." : "right.";
      for (int k = 0; k < (data_.fix_k3 ? kIntrinsics - 1 : kIntrinsics); ++k) {
        names.push_back(whose + kNames[static_cast<std::size_t>(k)]);
      }
    }
    if (optics_.size() > 1) names.insert(names.end(), kRigNames.begin(), kRigNames.end());
    return names;
  }

  BundleState state_;
  const BundleData& data_;
  std::vector<BundleOptics> optics_;
  Vector6 rig_ = Vector6::Zero();
  std::vector<Vector6> boards_;
  ceres::Problem ceres_;
};

// Residuals in pixels and areas, of the adjusted state.
void measure_fit(const BundleData& data, BundleOutcome& outcome) {
  double all = 0.0, count = 0.0;
  std::vector<double> areas;
  for (std::size_t camera = 0; camera < outcome.state.cameras.size(); ++camera) {
    outcome.view_rms_px.emplace_back();
    for (std::size_t view = 0; view < outcome.state.T_camera_board.size(); ++view) {
      const CameraFromBoard T = pose_in(outcome.state, camera, view);
      double squares = 0.0;
      for (std::size_t i = 0; i < data.board.size(); ++i) {
        const FoundPoint& found = data.found[camera][view].points[i];
        const ProjectedPoint seen = project_board_point(outcome.state.cameras[camera], T, data.board, i);
        squares += (found.pixel - seen.pixel).squaredNorm();
        if (seen.area_px2 > 0.0) areas.push_back(found.area_px2 / seen.area_px2);
      }
      outcome.view_rms_px.back().push_back(std::sqrt(squares / static_cast<double>(data.board.size())));
      all += squares;
      count += static_cast<double>(data.board.size());
    }
  }
  outcome.rms_px = std::sqrt(all / count);
  if (areas.empty()) return;
  const auto middle = areas.begin() + static_cast<std::ptrdiff_t>(areas.size() / 2);
  std::nth_element(areas.begin(), middle, areas.end());
  outcome.area_ratio = *middle;
}

}  // namespace

std::optional<BundleOutcome> adjust_boards(BundleState start, const BundleData& data) {
  Adjustment adjustment(std::move(start), data);
  if (!adjustment.solve()) return std::nullopt;
  std::optional<BundleOutcome> outcome = adjustment.outcome();
  if (outcome) measure_fit(data, *outcome);
  return outcome;
}

}  // namespace pharos::calibrate
