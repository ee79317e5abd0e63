// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/lighthouse/paper_target.hpp"

namespace pharos::tools {

Target paper_target() {
  Target target;
  std::uint8_t number = 0;
  const auto add = [&](const Vector3& position_m, const Vector3& normal) {
    target.push_back({number++, position_m, normal.normalized()});
  };
  for (const double x : {-0.025, 0.025}) {
    for (const double y : {-0.025, 0.025}) add({x, y, 0.0625}, Vector3::UnitZ());
  }
  // The second pair of slanted faces is the first one rotated by half a turn about z.
  for (const double side : {1.0, -1.0}) {
    const Vector3 along_x(2.0 * side, 0.0, 1.0);
    const Vector3 along_y(0.0, 2.0 * side, 1.0);
    add({0.055 * side, 0.035 * side, 0.015}, along_x);
    add({0.040 * side, -0.015 * side, 0.045}, along_x);
    add({-0.035 * side, 0.055 * side, 0.015}, along_y);
    add({0.015 * side, 0.040 * side, 0.045}, along_y);
  }
  return target;
}

}  // namespace pharos::tools
