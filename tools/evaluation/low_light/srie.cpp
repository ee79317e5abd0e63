// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "tools/evaluation/low_light/plane.hpp"
#include "tools/evaluation/low_light/published_methods.hpp"

namespace pharos::tools {
namespace {

constexpr double kC1 = 0.01, kC2 = 0.1;
constexpr double kGamma = 2.2;  // of the illumination's correction
constexpr double kStop = 1e-3;  // relative change of r and l
constexpr int kMaxTurns = 20;
constexpr double kMinGradient = 1e-3;  // the norm |.|_1 as a weighted square: 1 / max(|.|, this)
constexpr double kMinValue = 1.0 / 255.0;

// c2 |e^l grad l|^2: the weights are those of the last l.
Gradient weights_of_light(const Plane& l) {
  Gradient weights{l, l};
  for (std::size_t i = 0; i < l.values.size(); ++i) {
    weights.right.values[i] = weights.down.values[i] = kC2 * std::exp(2.0 * l.values[i]);
  }
  return weights;
}

// c1 |e^r grad r|_1.
Gradient weights_of_reflectance(const Plane& r) {
  Gradient weights = gradient_of(r);
  for (Plane* plane : {&weights.right, &weights.down}) {
    for (std::size_t i = 0; i < plane->values.size(); ++i) {
      plane->values[i] = 0.5 * kC1 * std::exp(r.values[i]) / std::max(kMinGradient, std::abs(plane->values[i]));
    }
  }
  return weights;
}

Plane difference(const Plane& a, const Plane& b) {
  Plane result = a;
  for (std::size_t i = 0; i < result.values.size(); ++i) result.values[i] -= b.values[i];
  return result;
}

double change(const Plane& now, const Plane& before) {
  double moved = 0.0, size = 0.0;
  for (std::size_t i = 0; i < now.values.size(); ++i) {
    const double step = now.values[i] - before.values[i];
    moved += step * step;
    size += before.values[i] * before.values[i];
  }
  return size > 0.0 ? std::sqrt(moved / size) : 1.0;
}

struct Parts {
  Plane r, l;
};

// Minimum of |r + l - s|^2 + c1 |e^r grad r|_1 + c2 |e^l grad l|^2 with r <= 0, s <= l, one after the other.
Parts split(const Plane& s) {
  Parts parts{{s.width_px, s.height_px}, s};
  for (int turn = 0; turn < kMaxTurns; ++turn) {
    const Parts before = parts;
    parts.r = smoothest(difference(s, parts.l), weights_of_reflectance(parts.r), parts.r);
    for (double& value : parts.r.values) value = std::min(0.0, value);
    parts.l = smoothest(difference(s, parts.r), weights_of_light(parts.l), parts.l);
    for (std::size_t i = 0; i < s.values.size(); ++i) {
      parts.l.values[i] = std::clamp(parts.l.values[i], s.values[i], 0.0);
    }
    if (change(parts.r, before.r) < kStop && change(parts.l, before.l) < kStop) break;
  }
  return parts;
}

}  // namespace

GreyBytes srie(const GreyBytes& image, int width_px, int height_px) {
  Plane s = plane_of(image, width_px, height_px);
  for (double& value : s.values) value = std::log(std::max(kMinValue, value));
  const Parts parts = split(s);
  Plane result = s;
  for (std::size_t i = 0; i < result.values.size(); ++i) {
    result.values[i] = std::exp(parts.r.values[i] + parts.l.values[i] / kGamma);
  }
  return bytes_of(result);
}

}  // namespace pharos::tools
