// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/quadtree.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <queue>

namespace pharos::slam {
namespace {

struct Part {
  float left, top, right, bottom;
  std::size_t first, count;  // its corners are contiguous
  std::size_t number;        // of creation: makes the order deterministic

  float area() const { return (right - left) * (bottom - top); }
};

struct Later {
  bool operator()(const Part& a, const Part& b) const {
    if (a.area() != b.area()) return a.area() < b.area();
    return a.count != b.count ? a.count < b.count : a.number > b.number;
  }
};

// Smallest part that is divided: closer corners are not separated.
constexpr float kSmallest_px = 2.0F;

}  // namespace

std::vector<Corner> spread(std::vector<Corner> corners, float width_px, float height_px, std::size_t wanted) {
  if (corners.size() <= wanted) return corners;
  std::priority_queue<Part, std::vector<Part>, Later> parts;
  std::vector<Part> finished;
  std::size_t number = 0;
  const auto add = [&](const Part& part) {
    if (part.count == 0) return;
    const bool whole =
        part.count == 1 || part.right - part.left < kSmallest_px || part.bottom - part.top < kSmallest_px;
    if (whole) {
      finished.push_back(part);
    } else {
      parts.push(part);
    }
  };
  // Images that are not square start as several parts that are nearly so.
  const auto columns = static_cast<std::size_t>(std::max(1.0F, std::round(width_px / height_px)));
  std::size_t first = 0;
  for (std::size_t c = 0; c < columns; ++c) {
    const float left = width_px * static_cast<float>(c) / static_cast<float>(columns);
    const float right = width_px * static_cast<float>(c + 1) / static_cast<float>(columns);
    const auto end = std::partition(corners.begin() + static_cast<std::ptrdiff_t>(first), corners.end(),
                                    [&](const Corner& k) { return k.u_px < right || c + 1 == columns; });
    const auto last = static_cast<std::size_t>(end - corners.begin());
    add({left, 0.0F, right, height_px, first, last - first, number++});
    first = last;
  }
  while (!parts.empty() && parts.size() + finished.size() < wanted) {
    const Part part = parts.top();
    parts.pop();
    const float u = 0.5F * (part.left + part.right), v = 0.5F * (part.top + part.bottom);
    const auto begin = corners.begin() + static_cast<std::ptrdiff_t>(part.first);
    const auto end = begin + static_cast<std::ptrdiff_t>(part.count);
    const auto middle = std::partition(begin, end, [v](const Corner& k) { return k.v_px < v; });
    const auto upper = std::partition(begin, middle, [u](const Corner& k) { return k.u_px < u; });
    const auto lower = std::partition(middle, end, [u](const Corner& k) { return k.u_px < u; });
    const auto place = [&](auto at) { return static_cast<std::size_t>(at - corners.begin()); };
    add({part.left, part.top, u, v, place(begin), place(upper) - place(begin), number++});
    add({u, part.top, part.right, v, place(upper), place(middle) - place(upper), number++});
    add({part.left, v, u, part.bottom, place(middle), place(lower) - place(middle), number++});
    add({u, v, part.right, part.bottom, place(lower), place(end) - place(lower), number++});
  }
  for (; !parts.empty(); parts.pop()) finished.push_back(parts.top());
  std::vector<Corner> kept;
  for (const Part& part : finished) {
    const auto begin = corners.begin() + static_cast<std::ptrdiff_t>(part.first);
    kept.push_back(*std::max_element(begin, begin + static_cast<std::ptrdiff_t>(part.count),
                                     [](const Corner& a, const Corner& b) { return a.response < b.response; }));
  }
  return kept;
}

}  // namespace pharos::slam
