// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/point_groups.hpp"

#include <algorithm>
#include <numeric>

namespace pharos::slam {
namespace {

using Places = std::vector<std::size_t>;

Eigen::Index longest_extent(const std::vector<Vector3>& points, Places::const_iterator first,
                            Places::const_iterator last) {
  Vector3 low = points[*first], high = low;
  for (auto at = first; at != last; ++at) {
    low = low.cwiseMin(points[*at]);
    high = high.cwiseMax(points[*at]);
  }
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  return axis;
}

}  // namespace

std::vector<std::size_t> point_groups(const std::vector<Vector3>& points, std::size_t minimum) {
  std::vector<std::size_t> groups(points.size(), 0);
  Places places(points.size());
  std::iota(places.begin(), places.end(), 0U);
  std::size_t count = 0;
  std::vector<std::pair<std::size_t, std::size_t>> parts{{0, places.size()}};  // from, to: not yet halved
  while (!parts.empty()) {
    const auto [from, to] = parts.back();
    parts.pop_back();
    const auto first = places.begin() + static_cast<std::ptrdiff_t>(from);
    const auto last = places.begin() + static_cast<std::ptrdiff_t>(to);
    if (to - from < 2 * std::max<std::size_t>(minimum, 1)) {
      for (auto at = first; at != last; ++at) groups[*at] = count;
      ++count;
      continue;
    }
    const Eigen::Index axis = longest_extent(points, first, last);
    const std::size_t half = from + (to - from) / 2;
    std::nth_element(first, places.begin() + static_cast<std::ptrdiff_t>(half), last,
                     [&](std::size_t a, std::size_t b) {
                       return points[a][axis] != points[b][axis] ? points[a][axis] < points[b][axis] : a < b;
                     });
    parts.emplace_back(half, to);
    parts.emplace_back(from, half);
  }
  return groups;
}

}  // namespace pharos::slam
