// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/keyframe_covariance.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <unordered_map>

#include "host/vision/slam/point_groups.hpp"

namespace pharos::slam {
namespace {

// Weak prior, so that the normal equations can always be solved.
constexpr double kMaxTurn_rad = 1.0, kMaxMove_m = 100.0;
constexpr double kMinInformation_m2 = 1e-6;  // of a point along a ray without stereo depth: a kilometre

// Of points whose errors are taken as related: some as many as are on one part of a body.
constexpr std::size_t kMinGroup = 20;
constexpr double kMinGroups = 6.0;       // of a keyframe
constexpr std::size_t kMaxGroups = 512;  // of a map: those of a larger one have more points

using Arm = Eigen::Matrix<double, 3, 6>;

// One keyframe's observation of a point: its information about the position, along the target's axes, and how its
// residual pulls at the point.
struct PoseInformation {
  int keyframe;
  Matrix3 information;
  Vector3 pull;
};

// The normal equations of all keyframes but the root, points eliminated; blocks on and below the diagonal.
class ReducedEquations {
 public:
  static constexpr int kRoot = -1;

  ReducedEquations(int keyframes, std::size_t groups)
      : keyframes_(keyframes), pulls_(Eigen::MatrixXd::Zero(6 * keyframes, static_cast<Eigen::Index>(groups))) {}

  // All observations of one point.
  void add(const Vector3& point_m, const std::vector<PoseInformation>& pose_terms, std::size_t group) {
    Matrix3 sum = kMinInformation_m2 * Matrix3::Identity();
    Vector3 pull = Vector3::Zero();
    for (const PoseInformation& term : pose_terms) {
      sum += term.information;
      pull += term.pull;
    }
    const Matrix3 spread = sum.inverse();
    const Vector3 moved = spread * pull;
    Arm arm;
    arm << -skew(point_m), Matrix3::Identity();
    for (const PoseInformation& a : pose_terms) {
      if (a.keyframe == kRoot) continue;
      pulls_.block<6, 1>(6 * a.keyframe, static_cast<Eigen::Index>(group)) +=
          arm.transpose() * (a.pull - a.information * moved);
      for (const PoseInformation& b : pose_terms) {
        if (b.keyframe == kRoot || b.keyframe > a.keyframe) continue;
        Matrix3 shared = -a.information * spread * b.information;
        if (a.keyframe == b.keyframe) shared += a.information;
        block(a.keyframe, b.keyframe) += arm.transpose() * (shared * arm).eval();
      }
    }
  }

  struct Solution {
    // The diagonal blocks of the inverse; empty where the equations are invalid (NaN).
    std::vector<Matrix6> covariances;
    double correlation_factor = 1.0;
  };
  Solution solve() {
    Eigen::SparseMatrix<double> H(6 * keyframes_, 6 * keyframes_);
    fill(H);
    const Factor factor(H);
    Solution out;
    if (factor.info() != Eigen::Success) return out;
    const Eigen::VectorXd over_d = factor.vectorD().cwiseInverse();
    Eigen::MatrixXd unit(6 * keyframes_, 6), column(6 * keyframes_, 6);
    for (int k = 0; k < keyframes_; ++k) {
      unit.setZero();
      unit.middleRows<6>(6 * k).setIdentity();
      column = factor.permutationP() * unit;
      factor.matrixL().solveInPlace(column);
      out.covariances.emplace_back(column.transpose() * over_d.asDiagonal() * column);
    }
    if (keyframes_ > 0) out.correlation_factor = correlation_factor(factor, out.covariances);
    return out;
  }

 private:
  using Factor = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>;

  // How far the groups pull the keyframes' poses (the sandwich estimator), over what independent errors would; at least
  // 1. The poses follow the pulls: of G groups, each of which fixes three of a pose's six coordinates, two in G is
  // lost.
  double correlation_factor(const Factor& factor, const std::vector<Matrix6>& covariances) const {
    const Eigen::MatrixXd moved = factor.solve(pulls_);
    double sum = 0.0, count = 0.0;
    for (std::size_t k = 0; k < covariances.size(); ++k) {
      const auto row = 6 * static_cast<Eigen::Index>(k);
      const Eigen::ArrayXd pulled = pulls_.middleRows<6>(row).colwise().squaredNorm().transpose();
      const auto groups = static_cast<double>((pulled > 0.0).count());
      if (groups < kMinGroups) continue;
      const Eigen::MatrixXd of_keyframe = moved.middleRows<6>(row);
      const double square = covariances[k].ldlt().solve(of_keyframe).cwiseProduct(of_keyframe).sum();
      sum += square / 6.0 * groups / (groups - 2.0);
      count += 1.0;
    }
    return count > 0.0 && std::isfinite(sum) ? std::max(1.0, sum / count) : 1.0;
  }

  Matrix6& block(int row, int column) {
    const auto [at, is_new] = blocks_.try_emplace(static_cast<std::int64_t>(row) * keyframes_ + column);
    if (is_new) at->second.setZero();
    return at->second;
  }

  void fill(Eigen::SparseMatrix<double>& H) {
    std::vector<Eigen::Triplet<double>> triplets;
    for (const auto& [at, entries] : blocks_) {
      const auto row = static_cast<int>(6 * (at / keyframes_)), column = static_cast<int>(6 * (at % keyframes_));
      for (int i = 0; i < 6; ++i) {
        for (int j = 0; j < 6; ++j) triplets.emplace_back(row + i, column + j, entries(i, j));
      }
    }
    for (int k = 0; k < 6 * keyframes_; ++k) {
      const double maximum = k % 6 < 3 ? kMaxTurn_rad : kMaxMove_m;
      triplets.emplace_back(k, k, 1.0 / (maximum * maximum));
    }
    H.setFromTriplets(triplets.begin(), triplets.end());
  }

  int keyframes_;
  std::unordered_map<std::int64_t, Matrix6> blocks_;
  Eigen::MatrixXd pulls_;  // of a group each
};

// The root and the keyframes that observe most of the points.
std::set<KeyframeId> best_seeing(const BundleProblem& problem, KeyframeId root, std::size_t maximum) {
  std::map<KeyframeId, int> seen;
  for (const auto& [id, pose] : problem.poses) seen[id] = 0;
  for (const BundleObservation& observation : problem.observations) ++seen[observation.keyframe];
  std::vector<std::pair<int, KeyframeId>> sorted;
  for (const auto& [id, count] : seen) {
    if (id != root) sorted.emplace_back(-count, id);
  }
  std::sort(sorted.begin(), sorted.end());
  std::set<KeyframeId> out;
  if (problem.poses.contains(root)) out.insert(root);
  for (const auto& [count, id] : sorted) {
    if (out.size() >= maximum) break;
    out.insert(id);
  }
  return out;
}

// Residuals that pass the test of chi-squared are as small as assumed, whatever the factor of the variances is.
PoseInformation information_of(int keyframe, const Observation& seen, const Vector3& point_m,
                               const StereoCamera& camera, const CameraFromTarget& pose, double variance_factor) {
  Observation at = seen;
  at.point_m = point_m;
  const Matrix3 J = residual_jacobian(at, camera, pose).rightCols<3>() * pose.R;
  return {keyframe, J.transpose() * J / (at.variance_px2 * variance_factor),
          J.transpose() * residual_of(at, camera, pose) / (at.variance_px2 * std::sqrt(variance_factor))};
}

// Each point's group.
std::map<PointId, std::size_t> groups_of(const BundleProblem& problem, std::size_t& count) {
  std::vector<Vector3> places;
  for (const auto& [id, place] : problem.points) places.push_back(place);
  const std::vector<std::size_t> groups = point_groups(places, std::max(kMinGroup, places.size() / kMaxGroups));
  std::map<PointId, std::size_t> out;
  count = 0;
  for (const auto& [id, place] : problem.points) {
    const std::size_t group = groups[out.size()];
    count = std::max(count, group + 1);
    out.emplace_hint(out.end(), id, group);
  }
  return out;
}

}  // namespace

KeyframeCovariances keyframe_covariances(const BundleProblem& problem, const std::vector<std::size_t>& rejected,
                                         const StereoCamera& camera, KeyframeId root, std::size_t maximum) {
  std::map<KeyframeId, int> places;
  int count = 0;
  for (const KeyframeId id : best_seeing(problem, root, maximum)) {
    places[id] = id == root ? ReducedEquations::kRoot : count++;
  }
  std::size_t group_count = 0;
  const std::map<PointId, std::size_t> groups = groups_of(problem, group_count);
  ReducedEquations equations(count, group_count);
  std::vector<bool> use(problem.observations.size(), true);
  for (const std::size_t k : rejected) use[k] = false;
  std::vector<PoseInformation> pose_terms;
  for (std::size_t k = 0; k < problem.observations.size(); ++k) {
    const BundleObservation& seen = problem.observations[k];
    const Vector3& point_m = problem.points.at(seen.point);
    const auto place = places.find(seen.keyframe);
    if (use[k] && place != places.end()) {
      const CameraFromTarget& pose = problem.poses.at(seen.keyframe);
      if ((pose * point_m).z() > kMinDepth_m) {
        const auto factor = problem.variance_factors.find(seen.keyframe);
        const double larger = factor == problem.variance_factors.end() ? 1.0 : factor->second;
        pose_terms.push_back(information_of(place->second, seen.seen, point_m, camera, pose, larger));
      }
    }
    const bool last = k + 1 == problem.observations.size() || problem.observations[k + 1].point != seen.point;
    if (!last) continue;
    if (pose_terms.size() > 1) equations.add(point_m, pose_terms, groups.at(seen.point));
    pose_terms.clear();
  }
  const ReducedEquations::Solution solved = equations.solve();
  KeyframeCovariances out;
  out.correlation_factor = solved.correlation_factor;
  for (const auto& [id, place] : places) {
    if (place == ReducedEquations::kRoot) {
      out.independent[id] = Matrix6::Zero();
    } else if (!solved.covariances.empty()) {
      out.independent[id] = solved.covariances[static_cast<std::size_t>(place)];
    }
  }
  return out;
}

void chain_covariance(Map& map, KeyframeId keyframe, const KeyframeCovariances& about) {
  std::optional<Matrix6> best;
  for (const auto& [id, between] : about.independent) {
    const auto other = map.keyframes.find(id);
    if (id == keyframe || other == map.keyframes.end()) continue;
    const Matrix6 sum = other->second.covariance + about.correlation_factor * between;
    if (!best || sum.topLeftCorner<3, 3>().trace() < best->topLeftCorner<3, 3>().trace()) best = sum;
  }
  if (best) map.keyframes.at(keyframe).covariance = *best;
}

void apply_covariances(const KeyframeCovariances& covariances, Map& map) {
  for (const auto& [id, covariance] : covariances.independent) {
    if (const auto at = map.keyframes.find(id); at != map.keyframes.end()) {
      at->second.covariance = covariances.correlation_factor * covariance;
    }
  }
}

Matrix6 turned(const Matrix3& R, const Matrix6& covariance) {
  Matrix6 turn = Matrix6::Zero();
  turn.topLeftCorner<3, 3>() = R;
  turn.bottomRightCorner<3, 3>() = R;
  return turn * covariance * turn.transpose();
}

}  // namespace pharos::slam
