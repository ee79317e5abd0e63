// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/steady_rotation.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "host/vision/slam/bundle_solver.hpp"
#include "host/vision/slam/rotation_jacobian.hpp"

namespace pharos::slam {
namespace {

// The rate, then a position for each pose, then the points. Ceres orders eliminated blocks by address: they are in one
// array in the order of their numbers.
struct Blocks {
  explicit Blocks(const BundleProblem& problem) : numbers(3 * (1 + problem.poses.size() + problem.points.size())) {
    double* at = numbers.data() + 3;
    for (const auto& [id, pose] : problem.poses) {
      places[id] = at;
      at = std::copy(pose.t.data(), pose.t.data() + 3, at);
    }
    for (const auto& [id, point] : problem.points) {
      points[id] = at;
      at = std::copy(point.data(), point.data() + 3, at);
    }
  }
  double* rate() { return numbers.data(); }
  std::vector<double> numbers;
  std::map<KeyframeId, double*> places;
  std::map<PointId, double*> points;
};

// One observation over the rate, the keyframe's position and the point; rows are whitened.
class SteadyReprojection : public ceres::CostFunction {
 public:
  SteadyReprojection(const Observation& seen, const StereoCamera& camera, const Matrix3& R_first, double since_first_s)
      : seen_(seen), camera_(camera), R_first_(R_first), since_first_s_(since_first_s) {
    set_num_residuals(seen.stereo() ? 3 : 2);
    mutable_parameter_block_sizes()->assign({3, 3, 3});
  }

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const Vector3 turned = Vector3(parameters[0]) * since_first_s_;
    const CameraFromTarget pose{rotation_exp(turned) * R_first_, Vector3(parameters[1])};
    Observation at = seen_;
    at.point_m = Vector3(parameters[2]);
    if (!in_front(pose, at.point_m)) return false;
    const double weight = 1.0 / std::sqrt(seen_.variance_px2);
    const Vector3 e = weight * residual_of(at, camera_, pose);
    std::copy_n(e.data(), num_residuals(), residuals);
    if (jacobians == nullptr) return true;
    const Eigen::Matrix<double, 3, 6> J = weight * residual_jacobian(at, camera_, pose);
    const Matrix3 by_turn = J.leftCols<3>(), by_place = J.rightCols<3>();
    write(by_turn * left_jacobian(turned) * since_first_s_, jacobians[0]);
    write(by_place, jacobians[1]);
    write(by_place * pose.R, jacobians[2]);
    return true;
  }

 private:
  void write(const Matrix3& J, double* out) const {
    if (out == nullptr) return;
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>>(out, num_residuals(), 3) =
        J.topRows(num_residuals());
  }

  Observation seen_;
  StereoCamera camera_;
  Matrix3 R_first_;
  double since_first_s_;
};

double huber_cost(const Observation& seen, const Vector3& point_m, const CameraFromTarget& pose,
                  const StereoCamera& camera) {
  if (!in_front(pose, point_m)) return 0.0;
  Observation at = seen;
  at.point_m = point_m;
  const double chi2 = residual_of(at, camera, pose).squaredNorm() / at.variance_px2;
  return chi2 > kHuberChi2 ? 2.0 * std::sqrt(kHuberChi2 * chi2) - kHuberChi2 : chi2;
}

// rho(s) = s / (1 + s / scale) of a chi-squared s (Geman and McClure 1987): far ones do not pull at all. The scale is
// that of chi-squared with three degrees of freedom.
class GemanMcClureLoss : public ceres::LossFunction {
 public:
  void Evaluate(double s, double* rho) const override {
    constexpr double kScale = 3.0;
    const double weight = 1.0 / (1.0 + s / kScale);
    rho[0] = s * weight;
    rho[1] = weight * weight;
    rho[2] = -2.0 * weight * weight * weight / kScale;
  }
};

class SteadyBundle {
 public:
  SteadyBundle(const BundleProblem& problem, const std::map<KeyframeId, double>& times_s, const StereoCamera& camera)
      : problem_(problem),
        times_s_(times_s),
        camera_(camera),
        first_(problem.poses.begin()->first),
        R_first_(problem.poses.begin()->second.R),
        blocks_(problem) {
    const SteadyRotation start = mean_rotation(problem.poses, times_s);
    std::copy_n(start.rate_rad_s.data(), 3, blocks_.rate());
  }

  SteadyRotation rotation() const {
    SteadyRotation out{Vector3(blocks_.numbers.data()), times_s_.at(first_), R_first_, Vector3::Zero(), 0.0};
    for (const auto& [id, block] : blocks_.points) out.middle_m += Vector3(block);
    out.middle_m /= static_cast<double>(std::max<std::size_t>(1, blocks_.points.size()));
    return out;
  }
  Vector3 place_of(KeyframeId id) const { return Vector3(blocks_.places.at(id)); }
  Vector3 point_of(PointId id) const { return Vector3(blocks_.points.at(id)); }

  void solve(int iterations, const std::vector<bool>& use, ceres::LossFunction& loss) {
    ceres::Problem::Options options;
    options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    ceres::Problem ceres(options);
    for (std::size_t k = 0; k < problem_.observations.size(); ++k) {
      const BundleObservation& observation = problem_.observations[k];
      if (!use[k]) continue;
      // NOLINTNEXTLINE(cppcoreguidelines-owning-memory): the problem owns it
      ceres.AddResidualBlock(
          new SteadyReprojection(observation.seen, camera_, R_first_, since_first_s(observation.keyframe)), &loss,
          blocks_.rate(), blocks_.places.at(observation.keyframe), blocks_.points.at(observation.point));
    }
    if (!ceres.HasParameterBlock(blocks_.rate())) return;
    auto* ordering = new ceres::ParameterBlockOrdering;  // NOLINT(cppcoreguidelines-owning-memory): the solver owns it
    ordering->AddElementToGroup(blocks_.rate(), 1);
    for (const auto& [id, block] : blocks_.places) {
      if (!ceres.HasParameterBlock(block)) continue;
      ordering->AddElementToGroup(block, 1);
      if (id == first_) ceres.SetParameterBlockConstant(block);
    }
    for (const auto& [id, block] : blocks_.points) {
      if (ceres.HasParameterBlock(block)) ordering->AddElementToGroup(block, 0);
    }
    ceres::Solver::Summary summary;
    ceres::Solve(bundle_options(ordering, blocks_.places.size(), iterations), &ceres, &summary);
  }

  bool is_in_front(const BundleObservation& o) const { return in_front(pose_of(o.keyframe), point_of(o.point)); }
  // From the problem's poses and points.
  double cost_increase() const {
    double sum = 0.0;
    for (const BundleObservation& o : problem_.observations) {
      sum += huber_cost(o.seen, point_of(o.point), pose_of(o.keyframe), camera_) -
             huber_cost(o.seen, problem_.points.at(o.point), problem_.poses.at(o.keyframe), camera_);
    }
    return sum;
  }
  bool accepts(const BundleObservation& o) const {
    return fits(o.seen, point_of(o.point), pose_of(o.keyframe), camera_);
  }

 private:
  CameraFromTarget pose_of(KeyframeId id) const {
    return {rotation_exp(Vector3(blocks_.numbers.data()) * since_first_s(id)) * R_first_, place_of(id)};
  }
  double since_first_s(KeyframeId id) const { return times_s_.at(id) - times_s_.at(first_); }

  const BundleProblem& problem_;
  const std::map<KeyframeId, double>& times_s_;
  const StereoCamera& camera_;
  KeyframeId first_;
  Matrix3 R_first_;
  Blocks blocks_;
};

}  // namespace

CameraFromTarget SteadyRotation::steadied(const CameraFromTarget& pose, double time_s) const {
  const Matrix3 R = R_at(time_s);
  return {R, pose.t + (pose.R - R) * middle_m};
}

Vector6 deviation_of(const CameraFromTarget& free, const CameraFromTarget& steady) {
  Vector6 out;
  out << rotation_log(free.R.transpose() * steady.R), free.R.transpose() * (steady.t - free.t);
  return out;
}

SteadyRotation mean_rotation(const KeyframePoses& poses, const std::map<KeyframeId, double>& times_s) {
  const auto& [first, first_pose] = *poses.begin();
  SteadyRotation out;
  out.first_s = times_s.at(first);
  out.R_first = first_pose.R;
  Vector3 turned = Vector3::Zero();
  Matrix3 R_before = first_pose.R;
  for (const auto& [id, pose] : poses) {
    turned += rotation_log(pose.R * R_before.transpose());
    R_before = pose.R;
  }
  out.rate_rad_s = turned / (times_s.at(poses.rbegin()->first) - out.first_s);
  return out;
}

SteadyRotation adjust_steady_rotation(BundleProblem& problem, const std::map<KeyframeId, double>& times_s,
                                      const StereoCamera& camera, int iterations, std::vector<std::size_t>& rejected) {
  SteadyBundle bundle(problem, times_s, camera);
  std::vector<bool> use;
  const auto use_where = [&](auto&& is_usable) {
    use.clear();
    for (const BundleObservation& observation : problem.observations) use.push_back(is_usable(observation));
  };
  const auto is_in_front = [&](const BundleObservation& o) { return bundle.is_in_front(o); };
  const auto is_accepted = [&](const BundleObservation& o) { return bundle.accepts(o); };
  ceres::HuberLoss huber(std::sqrt(kHuberChi2));
  use_where(is_in_front);
  bundle.solve(iterations, use, huber);
  use_where(is_accepted);
  bundle.solve(iterations, use, huber);
  const double cost_increase = bundle.cost_increase();
  GemanMcClureLoss redescending;
  use_where(is_in_front);
  bundle.solve(iterations, use, redescending);
  use_where(is_accepted);
  rejected.clear();
  for (std::size_t k = 0; k < use.size(); ++k) {
    if (!use[k]) rejected.push_back(k);
  }
  SteadyRotation out = bundle.rotation();
  out.cost_increase = cost_increase;
  for (auto& [id, pose] : problem.poses) pose = {out.R_at(times_s.at(id)), bundle.place_of(id)};
  for (auto& [id, point] : problem.points) point = bundle.point_of(id);
  return out;
}

double max_deviation(const KeyframePoses& free, const KeyframePoses& steady, const KeyframeCovariances& covariances) {
  double out = 0.0;
  for (const auto& [id, pose] : free) {
    if (id == free.begin()->first) continue;
    const auto at = covariances.independent.find(id);
    if (at == covariances.independent.end()) return std::numeric_limits<double>::infinity();
    const Vector3 off_rad = deviation_of(pose, steady.at(id)).head<3>();
    const Matrix3 covariance = covariances.correlation_factor * at->second.topLeftCorner<3, 3>();
    const double chi2 = off_rad.dot(covariance.ldlt().solve(off_rad)) / 3.0;
    if (!(chi2 >= 0.0)) return std::numeric_limits<double>::infinity();
    out = std::max(out, std::sqrt(chi2));
  }
  return out;
}

void add_deviations(const KeyframePoses& free, const KeyframePoses& steady, KeyframeCovariances& covariances) {
  for (auto& [id, covariance] : covariances.independent) {
    const Vector6 off = deviation_of(free.at(id), steady.at(id));
    covariance += off * off.transpose() / covariances.correlation_factor;
  }
}

}  // namespace pharos::slam
