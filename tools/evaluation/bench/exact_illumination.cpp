// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/bench/exact_illumination.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace pharos::tools {

using enhance::FloatImage;

FloatImage exact_illumination(const enhance::SmoothnessSystem& system, const FloatImage& start) {
  const auto pixels = static_cast<int>(start.pixels());
  std::vector<double> diagonal(start.pixels(), 1.0);
  std::vector<Eigen::Triplet<double>> entries;
  const auto link = [&](int from, int to, float weight) {
    if (weight <= 0.0F) return;
    const auto value = static_cast<double>(weight);
    diagonal[static_cast<std::size_t>(from)] += value;
    diagonal[static_cast<std::size_t>(to)] += value;
    entries.emplace_back(to, from, -value);  // the lower half
  };
  for (int k = 0; k < pixels; ++k) {
    link(k, k + 1, system.right[static_cast<std::size_t>(k)]);
    link(k, k + system.width_px, system.down[static_cast<std::size_t>(k)]);
  }
  for (int k = 0; k < pixels; ++k) entries.emplace_back(k, k, diagonal[static_cast<std::size_t>(k)]);
  Eigen::SparseMatrix<double> matrix(pixels, pixels);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(matrix);
  if (factors.info() != Eigen::Success) throw std::runtime_error("the system of (5) has no factors");
  const Eigen::VectorXd right = Eigen::Map<const Eigen::VectorXf>(start.values.data(), pixels).cast<double>();
  const Eigen::VectorXf solution = factors.solve(right).cast<float>();
  FloatImage refined = start;
  std::copy_n(solution.data(), pixels, refined.values.begin());
  return refined;
}

double rms_of_range(const FloatImage& found, const FloatImage& exact) {
  double sum = 0.0;
  for (std::size_t k = 0; k < exact.values.size(); ++k) {
    const double off = static_cast<double>(found.values[k]) - static_cast<double>(exact.values[k]);
    sum += off * off;
  }
  const auto [low, high] = std::minmax_element(exact.values.begin(), exact.values.end());
  return std::sqrt(sum / static_cast<double>(exact.values.size())) / static_cast<double>(*high - *low);
}

}  // namespace pharos::tools
