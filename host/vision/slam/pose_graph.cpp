// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/pose_graph.hpp"

#include <ceres/ceres.h>

#include "host/vision/slam/pose_blocks.hpp"

namespace pharos::slam {
namespace {

constexpr int kMaxSteps = 50;

using Block67 = Eigen::Matrix<double, 6, 7, Eigen::RowMajor>;

// Derivative of log(exp(delta) R) at R = exp(phi), to second order: residuals are small where it matters.
Matrix3 inverse_left_jacobian(const Vector3& phi) {
  const Matrix3 cross = skew(phi);
  return Matrix3::Identity() - 0.5 * cross + cross * cross / 12.0;
}

class EdgeCost : public ceres::SizedCostFunction<6, 7, 7> {
 public:
  explicit EdgeCost(const PoseEdge& edge) : edge_(edge) {}

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const CameraFromTarget from = slam::pose_of(parameters[0]), to = slam::pose_of(parameters[1]);
    const Vector6 r = edge_residual(edge_, from, to);
    Eigen::Map<Vector6>(residuals, 6) = r;
    if (jacobians == nullptr) return true;
    const Matrix3 turn = from.R * to.R.transpose();
    const Matrix3 J = inverse_left_jacobian(r.head<3>());
    if (jacobians[0] != nullptr) {
      Eigen::Map<Block67> out(jacobians[0]);
      out.setZero();
      out.block<3, 3>(0, 0) = J;
      out.block<3, 3>(3, 0) = skew(turn * to.t);
      out.block<3, 3>(3, 3) = Matrix3::Identity();
    }
    if (jacobians[1] != nullptr) {
      Eigen::Map<Block67> out(jacobians[1]);
      out.setZero();
      out.block<3, 3>(0, 0) = -J * turn;
      out.block<3, 3>(3, 0) = -turn * skew(to.t);
      out.block<3, 3>(3, 3) = -turn;
    }
    return true;
  }

 private:
  PoseEdge edge_;
};

}  // namespace

Vector6 edge_residual(const PoseEdge& edge, const CameraFromTarget& from, const CameraFromTarget& to) {
  const Matrix3 turn = from.R * to.R.transpose();
  Vector6 r;
  r << rotation_log(turn * edge.T_from_to.R.transpose()), from.t - turn * to.t - edge.T_from_to.t;
  return r;
}

void adjust_pose_graph(std::map<KeyframeId, CameraFromTarget>& poses, const std::vector<PoseEdge>& edges,
                       const std::vector<KeyframeId>& fixed) {
  // In one array, because Ceres may order by address.
  std::vector<PoseBlock> numbers;
  numbers.reserve(poses.size());
  std::map<KeyframeId, double*> blocks;
  for (const auto& [id, pose] : poses) blocks[id] = numbers.emplace_back(block_of(pose)).data();
  PoseManifold manifold;
  ceres::Problem::Options options;
  options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(options);
  for (const PoseEdge& edge : edges) {
    // NOLINTNEXTLINE(cppcoreguidelines-owning-memory): the problem owns it
    problem.AddResidualBlock(new EdgeCost(edge), nullptr, blocks.at(edge.from), blocks.at(edge.to));
  }
  for (const auto& [id, block] : blocks) {
    if (problem.HasParameterBlock(block)) problem.SetManifold(block, &manifold);
  }
  for (const KeyframeId id : fixed) {
    if (problem.HasParameterBlock(blocks.at(id))) problem.SetParameterBlockConstant(blocks.at(id));
  }
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  solver.max_num_iterations = kMaxSteps;
  solver.num_threads = 1;
  solver.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  for (auto& [id, pose] : poses) pose = slam::pose_of(blocks.at(id));
}

}  // namespace pharos::slam
