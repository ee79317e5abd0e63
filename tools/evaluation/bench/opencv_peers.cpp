// SPDX-License-Identifier: Apache-2.0
// OpenCV's PnP solvers behind the benchmark's function. Wrapping the arrays costs some 100 ns.
#include <algorithm>
#include <opencv2/calib3d.hpp>
#include <vector>

#include "tools/evaluation/bench/peer_solver.hpp"

namespace {

cv::SolvePnPMethod method_of(pharos::tools::Peer peer) {
  switch (peer) {
    case pharos::tools::Peer::kSqpnp:
      return cv::SOLVEPNP_SQPNP;
    case pharos::tools::Peer::kEpnp:
      return cv::SOLVEPNP_EPNP;
    case pharos::tools::Peer::kIterative:
      return cv::SOLVEPNP_ITERATIVE;
  }
  return cv::SOLVEPNP_SQPNP;
}

// OpenCV takes arrays that it only reads by pointers to non-const.
cv::Mat wrapped(const double* values, int rows, int columns) {
  return cv::Mat(rows, 1, CV_MAKETYPE(CV_64F, columns), const_cast<double*>(values));
}

}  // namespace

extern "C" bool pharos_bench_peer(int peer, const double* body, const double* tangents, int count, double* rotation,
                                  double* translation) {
  static const cv::Mat camera = cv::Mat::eye(3, 3, CV_64F);
  try {
    // SQPNP may answer several poses in no order: the caller's share is to take the one that reprojects best.
    std::vector<cv::Mat> rotation_vectors, translations;
    std::vector<double> errors;
    cv::solvePnPGeneric(wrapped(body, count, 3), wrapped(tangents, count, 2), camera, cv::noArray(), rotation_vectors,
                        translations, false, method_of(static_cast<pharos::tools::Peer>(peer)), cv::noArray(),
                        cv::noArray(), errors);
    if (errors.empty()) return false;
    const auto best = static_cast<std::size_t>(std::min_element(errors.begin(), errors.end()) - errors.begin());
    const cv::Vec3d rotation_vector = rotation_vectors[best], t = translations[best];
    cv::Matx33d R;
    cv::Rodrigues(rotation_vector, R);
    for (int k = 0; k < 9; ++k) rotation[k] = R.val[k];
    for (int k = 0; k < 3; ++k) translation[k] = t[k];
    return true;
  } catch (const cv::Exception&) {
    return false;
  }
}
