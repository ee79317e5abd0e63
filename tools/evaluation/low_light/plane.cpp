// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/low_light/plane.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace pharos::tools {
namespace {

double dot(const Plane& a, const Plane& b) {
  return std::inner_product(a.values.begin(), a.values.end(), b.values.begin(), 0.0);
}

void add(Plane& to, double factor, const Plane& plane) {
  for (std::size_t i = 0; i < to.values.size(); ++i) to.values[i] += factor * plane.values[i];
}

// Visits every pair of neighbours: visit(index, index, weight).
template <class Visit>
void for_neighbours(const Gradient& weights, Visit&& visit) {
  const Plane& right = weights.right;
  for (int v = 0; v < right.height_px; ++v) {
    for (int u = 0; u < right.width_px; ++u) {
      const std::size_t here = right.index(u, v);
      if (u + 1 < right.width_px) visit(here, here + 1, right.values[here]);
      if (v + 1 < right.height_px) visit(here, right.index(u, v + 1), weights.down.values[here]);
    }
  }
}

// (I + D^T W D) x.
Plane applied(const Gradient& weights, const Plane& x) {
  Plane result = x;
  for_neighbours(weights, [&](std::size_t a, std::size_t b, double weight) {
    const double flow = weight * (x.values[a] - x.values[b]);
    result.values[a] += flow;
    result.values[b] -= flow;
  });
  return result;
}

Plane diagonal_of(const Gradient& weights) {
  Plane diagonal(weights.right.width_px, weights.right.height_px, 1.0);
  for_neighbours(weights, [&](std::size_t a, std::size_t b, double weight) {
    diagonal.values[a] += weight;
    diagonal.values[b] += weight;
  });
  return diagonal;
}

Plane divided(Plane plane, const Plane& by) {
  for (std::size_t i = 0; i < plane.values.size(); ++i) plane.values[i] /= by.values[i];
  return plane;
}

}  // namespace

Plane plane_of(const GreyBytes& image, int width_px, int height_px) {
  Plane plane(width_px, height_px);
  std::transform(image.begin(), image.end(), plane.values.begin(), [](std::uint8_t value) { return value / 255.0; });
  return plane;
}

GreyBytes bytes_of(const Plane& plane) {
  GreyBytes bytes;
  for (const double value : plane.values) {
    bytes.push_back(static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(value, 0.0, 1.0))));
  }
  return bytes;
}

Gradient gradient_of(const Plane& plane) {
  Gradient gradient{{plane.width_px, plane.height_px}, {plane.width_px, plane.height_px}};
  for (int v = 0; v < plane.height_px; ++v) {
    for (int u = 0; u < plane.width_px; ++u) {
      if (u + 1 < plane.width_px) gradient.right.at(u, v) = plane.at(u + 1, v) - plane.at(u, v);
      if (v + 1 < plane.height_px) gradient.down.at(u, v) = plane.at(u, v + 1) - plane.at(u, v);
    }
  }
  return gradient;
}

Plane smoothest(const Plane& data, const Gradient& weights, const Plane& start, const SolverLimits& limits) {
  const Plane diagonal = diagonal_of(weights);
  Plane x = start, residual = data;
  add(residual, -1.0, applied(weights, x));
  Plane direction = divided(residual, diagonal);
  double energy = dot(residual, direction);
  const double enough = limits.residual * limits.residual * dot(data, data);
  for (int k = 0; k < limits.iterations && dot(residual, residual) > enough; ++k) {
    const Plane moved = applied(weights, direction);
    const double step = energy / dot(direction, moved);
    add(x, step, direction);
    add(residual, -step, moved);
    Plane next = divided(residual, diagonal);
    const double left = dot(residual, next);
    add(next, left / energy, direction);
    direction = std::move(next);
    energy = left;
  }
  return x;
}

}  // namespace pharos::tools
