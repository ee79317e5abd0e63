// SPDX-License-Identifier: Apache-2.0
#include "pharos/pose/fixed_descent.hpp"

namespace pharos::pose {
namespace {

using fixed::product;
using fixed::Q30;
using fixed::times;

// Unique elements of a symmetric 3x3 matrix: xx yy zz xy xz yz.
using Symmetric = std::array<std::int64_t, 6>;

// Scaled by the power of two that makes the largest element fill 29 bits.
std::array<std::int32_t, 6> normalised(const Symmetric& m) {
  const int largest = fixed::max_bits_of(m);
  std::array<std::int32_t, 6> out;
  for (std::size_t k = 0; k < 6; ++k) out[k] = static_cast<std::int32_t>(fixed::shifted(m[k], 29 - largest));
  return out;
}

Symmetric adjugate(const std::array<std::int32_t, 6>& m) {
  const auto [xx, yy, zz, xy, xz, yz] = m;
  return {product(yy, zz) - product(yz, yz), product(xx, zz) - product(xz, xz), product(xx, yy) - product(xy, xy),
          product(xz, yz) - product(xy, zz), product(xy, yz) - product(xz, yy), product(xy, xz) - product(yz, xx)};
}

Symmetric squared(const std::array<std::int32_t, 6>& m) {
  const auto [xx, yy, zz, xy, xz, yz] = m;
  return {product(xx, xx) + product(xy, xy) + product(xz, xz), product(xy, xy) + product(yy, yy) + product(yz, yz),
          product(xz, xz) + product(yz, yz) + product(zz, zz), product(xx, xy) + product(xy, yy) + product(xz, yz),
          product(xx, xz) + product(xy, yz) + product(xz, zz), product(xy, xz) + product(yy, yz) + product(yz, zz)};
}

// Unit vector along v, whose elements stay below 2^30.
FixedVector unit(const FixedVector& v) {
  const int largest = fixed::max_bits_of(v);
  std::array<std::int64_t, 3> scaled{};
  std::int64_t square = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    scaled[k] = fixed::shifted(v[k], 29 - largest);  // shorter than 0.87
    square += scaled[k] * scaled[k];
  }
  if (square == 0) return {0, 0, fixed::kOne};
  const fixed::Root root = fixed::root_of(square);
  FixedVector out;
  for (std::size_t k = 0; k < 3; ++k) {
    out[k] = static_cast<Q30>(fixed::shifted((scaled[k] * root.inverse) >> 30, root.binary_exponent));
  }
  return out;
}

// The direction of minimum variance, as PlaneFit::normal.
FixedVector plane_normal(const FixedObservationTable& s) {
  constexpr int kSquarings = 4;
  Symmetric scatter{};
  for (int k = 0; k < s.count; ++k) {
    const FixedVector& b = s.sensor[static_cast<std::size_t>(k)].body;
    const std::int32_t x = b[0] >> 2, y = b[1] >> 2, z = b[2] >> 2;  // 32 of them stay within 64 bits
    const Symmetric more{product(x, x), product(y, y), product(z, z), product(x, y), product(x, z), product(y, z)};
    for (std::size_t i = 0; i < 6; ++i) scatter[i] += more[i];
  }
  std::array<std::int32_t, 6> power = normalised(adjugate(normalised(scatter)));
  for (int k = 0; k < kSquarings; ++k) power = normalised(squared(power));
  const auto [xx, yy, zz, xy, xz, yz] = power;
  if (xx >= yy && xx >= zz) return unit({xx, xy, xz});
  if (yy >= zz) return unit({xy, yy, yz});
  return unit({xz, yz, zz});
}

Q30 dot(const FixedVector& a, const FixedVector& b) {
  return static_cast<Q30>((product(a[0], b[0]) + product(a[1], b[1]) + product(a[2], b[2])) >> 30);
}

}  // namespace

FixedPose FixedSystem::mirrored(const FixedPose& pose) const {
  const FixedVector n_body = plane_normal(table_);
  const FixedVector n = turned(pose, n_body);
  const FixedVector s = unit({pose.centroid[0] / 2, pose.centroid[1] / 2, pose.centroid[2] / 2});
  FixedPose out = pose;
  for (std::size_t c = 0; c < 3; ++c) {
    FixedVector& column = out.column[c];
    for (std::size_t i = 0; i < 3; ++i) column[i] -= 2 * times(n[i], n_body[c]);
    const Q30 along = dot(s, column);
    for (std::size_t i = 0; i < 3; ++i) column[i] -= 2 * times(s[i], along);
  }
  return out;
}

}  // namespace pharos::pose
