// SPDX-License-Identifier: Apache-2.0
// OpenCV's solvers. Wrapping the arrays costs some 100 ns.
#include <algorithm>
#include <opencv2/calib3d.hpp>

#include "tools/evaluation/bench/peer_solver.hpp"

namespace pharos::tools {
namespace {

cv::SolvePnPMethod method_of(Peer peer) {
  switch (peer) {
    case Peer::kSqpnp:
      return cv::SOLVEPNP_SQPNP;
    case Peer::kEpnp:
      return cv::SOLVEPNP_EPNP;
    case Peer::kIterative:
      return cv::SOLVEPNP_ITERATIVE;
  }
  return cv::SOLVEPNP_SQPNP;
}

// OpenCV takes read-only arrays by pointers to non-const.
cv::Mat wrapped(const std::vector<double>& values, int columns) {
  return cv::Mat(static_cast<int>(values.size()) / columns, 1, CV_MAKETYPE(CV_64F, columns),
                 const_cast<double*>(values.data()));
}

}  // namespace

std::optional<LighthouseFromBody> solve_by_peer(Peer peer, const std::vector<double>& body,
                                                const std::vector<double>& tangents) try {
  static const cv::Mat camera = cv::Mat::eye(3, 3, CV_64F);
  // SQPNP may return several poses in any order: the caller selects the one with the smallest reprojection error.
  std::vector<cv::Mat> rotation_vectors, translations;
  std::vector<double> errors;
  cv::solvePnPGeneric(wrapped(body, 3), wrapped(tangents, 2), camera, cv::noArray(), rotation_vectors, translations,
                      false, method_of(peer), cv::noArray(), cv::noArray(), errors);
  if (errors.empty()) return std::nullopt;
  const auto best = static_cast<std::size_t>(std::min_element(errors.begin(), errors.end()) - errors.begin());
  const cv::Vec3d rotation_vector = rotation_vectors[best], t = translations[best];
  cv::Matx33d R;
  cv::Rodrigues(rotation_vector, R);
  return LighthouseFromBody{Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(R.val), {t[0], t[1], t[2]}};
} catch (const cv::Exception&) {
  return std::nullopt;
}

}  // namespace pharos::tools
