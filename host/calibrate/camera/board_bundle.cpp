// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/camera/board_bundle.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "pharos/geometry/rotation.hpp"

namespace pharos::calibrate {
namespace {

constexpr int kMaxSteps = 100;
constexpr double kConverged = 1e-12;     // relative change of the squares
constexpr Eigen::Index kIntrinsics = 9;  // fx, fy, cx, cy, k1, k2, p1, p2, k3
constexpr Eigen::Index kPose = 6;
constexpr std::array<const char*, kIntrinsics> kNames{"fx_px", "fy_px", "cx_px", "cy_px", "k1", "k2", "p1", "p2", "k3"};
constexpr std::array<const char*, kPose> kRigNames{"right.rotation_x_rad", "right.rotation_y_rad",
                                                   "right.rotation_z_rad", "right.position_x_m",
                                                   "right.position_y_m",   "right.position_z_m"};

using Matrix2X = Eigen::Matrix<double, 2, Eigen::Dynamic>;
using Matrix26 = Eigen::Matrix<double, 2, 6>;
using Matrix36 = Eigen::Matrix<double, 3, 6>;

// Where each unknown stands: what all views share first.
struct Layout {
  Eigen::Index cameras = 0;
  Eigen::Index intrinsics = 0;  // of each camera

  Layout(const BundleState& state, const BundleData& data)
      : cameras(static_cast<Eigen::Index>(state.cameras.size())),
        intrinsics(data.fix_k3 ? kIntrinsics - 1 : kIntrinsics) {}
  Eigen::Index rig() const { return cameras * intrinsics; }
  Eigen::Index shared() const { return rig() + (cameras > 1 ? kPose : 0); }
};

CameraFromBoard pose_in(const BundleState& state, std::size_t camera, std::size_t view) {
  const CameraFromBoard& T = state.T_camera_board[view];
  return camera == 0 ? T : state.T_left_right.inverse() * T;
}

// d pixel / d (fx, fy, cx, cy, k1, k2, p1, p2, k3) of an ideal ray.
Eigen::Matrix<double, 2, kIntrinsics> by_optics(const PinholeCamera& camera, const Vector2& ray) {
  const double x = ray.x(), y = ray.y(), r2 = ray.squaredNorm();
  const Vector2 pixel = distort(camera, ray);
  const double fx = camera.fx_px, fy = camera.fy_px;
  Eigen::Matrix<double, 2, kIntrinsics> J;
  J << (pixel.x() - camera.cx_px) / fx, 0.0, 1.0, 0.0, fx * x * r2, fx * x * r2 * r2, fx * 2.0 * x * y,
      fx * (r2 + 2.0 * x * x), fx * x * r2 * r2 * r2,  //
      0.0, (pixel.y() - camera.cy_px) / fy, 0.0, 1.0, fy * y * r2, fy * y * r2 * r2, fy * (r2 + 2.0 * y * y),
      fy * 2.0 * x * y, fy * y * r2 * r2 * r2;
  return J;
}

// One point: its residual, and how its image moves with the shared unknowns and with the board's pose.
struct Row {
  Vector2 residual;
  Matrix2X by_shared;
  Matrix26 by_board;
};

// Derivatives are those of the point's own image: a dot's centroid moves with it to within 1e-3, which slows the last
// steps a little and changes nothing where they end.
Row row_of(const BundleState& state, const BundleData& data, const Layout& layout, std::size_t camera, std::size_t view,
           std::size_t point) {
  const FoundPoint& found = data.found[camera][view].points[point];
  const PinholeCamera& intrinsics = state.cameras[camera];
  const CameraFromBoard T = pose_in(state, camera, view);
  const Vector3 p_left = state.T_camera_board[view] * data.board.point_m(point);
  const Vector3 p = T * data.board.point_m(point);
  const double weight = 1.0 / found.sigma_px;
  Row row;
  row.residual = weight * (found.pixel - project_board_point(intrinsics, T, data.board, point).pixel);
  row.by_shared = Matrix2X::Zero(2, layout.shared());
  row.by_shared.middleCols(static_cast<Eigen::Index>(camera) * layout.intrinsics, layout.intrinsics) =
      weight * by_optics(intrinsics, p.hnormalized()).leftCols(layout.intrinsics);
  const Matrix23 by_point = weight * project_jacobian(intrinsics, p);
  Matrix36 board_moves;
  board_moves << -skew(state.T_camera_board[view].R * data.board.point_m(point)), Matrix3::Identity();
  if (camera == 0) {
    row.by_board = by_point * board_moves;
  } else {
    const Matrix3 R_right_left = state.T_left_right.R.transpose();
    row.by_board = by_point * R_right_left * board_moves;
    Matrix36 rig_moves;
    rig_moves << skew(p_left - state.T_left_right.t), -Matrix3::Identity();
    row.by_shared.middleCols(layout.rig(), kPose) = by_point * R_right_left * rig_moves;
  }
  return row;
}

bool in_front(const BundleState& state, const BundleData& data) {
  for (std::size_t camera = 0; camera < state.cameras.size(); ++camera) {
    if (!is_usable(state.cameras[camera])) return false;
    for (std::size_t view = 0; view < state.T_camera_board.size(); ++view) {
      const CameraFromBoard T = pose_in(state, camera, view);
      for (std::size_t i = 0; i < data.board.size(); ++i) {
        if (!((T * data.board.point_m(i)).z() > data.board.radius_m)) return false;
      }
    }
  }
  return true;
}

double squares_of(const BundleState& state, const BundleData& data) {
  if (!in_front(state, data)) return std::numeric_limits<double>::infinity();
  double squares = 0.0;
  for (std::size_t camera = 0; camera < state.cameras.size(); ++camera) {
    for (std::size_t view = 0; view < state.T_camera_board.size(); ++view) {
      const CameraFromBoard T = pose_in(state, camera, view);
      for (std::size_t i = 0; i < data.board.size(); ++i) {
        const FoundPoint& found = data.found[camera][view].points[i];
        const Vector2 predicted = project_board_point(state.cameras[camera], T, data.board, i).pixel;
        squares += (found.pixel - predicted).squaredNorm() / (found.sigma_px * found.sigma_px);
      }
    }
  }
  return squares;
}

// Normal equations in the shape that they have: what views share, and each view's own board.
struct ViewBlock {
  Eigen::Matrix<double, 6, Eigen::Dynamic> with_shared;
  Matrix6 own = Matrix6::Zero();
  Vector6 gradient = Vector6::Zero();
};
struct Normal {
  Eigen::MatrixXd shared;
  Eigen::VectorXd gradient;
  std::vector<ViewBlock> views;
};

Normal normal_of(const BundleState& state, const BundleData& data, const Layout& layout) {
  Normal normal;
  normal.shared = Eigen::MatrixXd::Zero(layout.shared(), layout.shared());
  normal.gradient = Eigen::VectorXd::Zero(layout.shared());
  for (std::size_t view = 0; view < state.T_camera_board.size(); ++view) {
    ViewBlock block;
    block.with_shared.setZero(kPose, layout.shared());
    for (std::size_t camera = 0; camera < state.cameras.size(); ++camera) {
      for (std::size_t i = 0; i < data.board.size(); ++i) {
        const Row row = row_of(state, data, layout, camera, view, i);
        normal.shared.noalias() += row.by_shared.transpose() * row.by_shared;
        normal.gradient.noalias() += row.by_shared.transpose() * row.residual;
        block.with_shared.noalias() += row.by_board.transpose() * row.by_shared;
        block.own += row.by_board.transpose() * row.by_board;
        block.gradient += row.by_board.transpose() * row.residual;
      }
    }
    normal.views.push_back(std::move(block));
  }
  return normal;
}

// The board poses eliminated. `damping` is relative to each diagonal.
struct Reduced {
  Eigen::MatrixXd shared;
  Eigen::VectorXd gradient;
};
Matrix6 damped(const Matrix6& own, double damping) {
  Matrix6 result = own;
  result.diagonal() *= 1.0 + damping;
  return result;
}
Reduced reduced(const Normal& normal, double damping) {
  Reduced result{normal.shared, normal.gradient};
  result.shared.diagonal() *= 1.0 + damping;
  for (const ViewBlock& view : normal.views) {
    const auto own = damped(view.own, damping).ldlt();
    result.shared.noalias() -= view.with_shared.transpose() * own.solve(view.with_shared);
    result.gradient.noalias() -= view.with_shared.transpose() * own.solve(view.gradient);
  }
  return result;
}

PinholeCamera moved(PinholeCamera camera, const Eigen::VectorXd& by) {
  camera.fx_px += by[0];
  camera.fy_px += by[1];
  camera.cx_px += by[2];
  camera.cy_px += by[3];
  for (Eigen::Index k = 4; k < by.size(); ++k) camera.distortion[static_cast<std::size_t>(k - 4)] += by[k];
  return camera;
}

BundleState stepped(const BundleState& state, const Normal& normal, const Layout& layout, double damping) {
  const Reduced equations = reduced(normal, damping);
  const Eigen::VectorXd shared = equations.shared.ldlt().solve(equations.gradient);
  BundleState next = state;
  for (Eigen::Index camera = 0; camera < layout.cameras; ++camera) {
    const auto c = static_cast<std::size_t>(camera);
    next.cameras[c] = moved(state.cameras[c], shared.segment(camera * layout.intrinsics, layout.intrinsics));
  }
  if (layout.cameras > 1) next.T_left_right = state.T_left_right.moved_by(shared.segment<kPose>(layout.rig()));
  for (std::size_t view = 0; view < next.T_camera_board.size(); ++view) {
    const ViewBlock& block = normal.views[view];
    const Vector6 own = damped(block.own, damping).ldlt().solve(block.gradient - block.with_shared * shared);
    CameraFromBoard& T = next.T_camera_board[view];
    T = T.moved_by(own);
    T.R = orthonormalised(T.R);
  }
  next.T_left_right.R = orthonormalised(next.T_left_right.R);
  return next;
}

std::vector<std::string> names(const Layout& layout) {
  std::vector<std::string> result;
  for (Eigen::Index camera = 0; camera < layout.cameras; ++camera) {
    const std::string whose = layout.cameras == 1 ? "" : camera == 0 ? "left." : "right.";
    for (Eigen::Index k = 0; k < layout.intrinsics; ++k) result.push_back(whose + kNames[static_cast<std::size_t>(k)]);
  }
  if (layout.cameras > 1) result.insert(result.end(), kRigNames.begin(), kRigNames.end());
  return result;
}

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

std::optional<BundleOutcome> outcome_of(BundleState state, const BundleData& data, const Layout& layout,
                                        double squares) {
  BundleOutcome outcome;
  const double measured =
      2.0 * static_cast<double>(state.cameras.size() * state.T_camera_board.size() * data.board.size());
  const double unknowns = static_cast<double>(layout.shared()) +
                          static_cast<double>(kPose) * static_cast<double>(state.T_camera_board.size());
  if (measured <= unknowns) return std::nullopt;
  const double variance = squares / (measured - unknowns);
  const Eigen::MatrixXd information = reduced(normal_of(state, data, layout), 0.0).shared;
  const auto factors = information.ldlt();
  if (factors.info() != Eigen::Success || !factors.isPositive()) return std::nullopt;
  outcome.covariance = variance * factors.solve(Eigen::MatrixXd::Identity(layout.shared(), layout.shared()));
  if (!outcome.covariance.allFinite() || !(outcome.covariance.diagonal().minCoeff() > 0.0)) return std::nullopt;
  outcome.noise_ratio = std::sqrt(variance);
  outcome.parameters = names(layout);
  outcome.state = std::move(state);
  measure_fit(data, outcome);
  return outcome;
}

}  // namespace

std::optional<BundleOutcome> adjust_boards(BundleState start, const BundleData& data) {
  BundleState state = std::move(start);
  if (data.fix_k3) {
    for (PinholeCamera& camera : state.cameras) camera.distortion[4] = 0.0;
  }
  const Layout layout(state, data);
  double squares = squares_of(state, data);
  if (!std::isfinite(squares)) return std::nullopt;
  double damping = 1e-4;
  for (int step = 0; step < kMaxSteps && damping < 1e8; ++step) {
    const Normal normal = normal_of(state, data, layout);
    double after = std::numeric_limits<double>::infinity();
    BundleState next;
    while (damping < 1e8) {
      next = stepped(state, normal, layout, damping);
      after = squares_of(next, data);
      if (after <= squares) break;
      damping *= 10.0;
    }
    if (!(after <= squares)) break;
    const bool done = squares - after <= kConverged * squares;
    state = std::move(next);
    squares = after;
    damping = std::max(damping * 0.1, 1e-12);
    if (done) break;
  }
  return outcome_of(std::move(state), data, layout, squares);
}

}  // namespace pharos::calibrate
