// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pharos::sim {

/// Grey light of every pixel, linear, row by row. 1 is white: what a POV-Ray colour of `rgb 1` sends.
struct LinearImage {
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
  std::vector<float> light;

  float at(std::int32_t u, std::int32_t v) const { return light[index(u, v)]; }
  float& at(std::int32_t u, std::int32_t v) { return light[index(u, v)]; }

 private:
  std::size_t index(std::int32_t u, std::int32_t v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width_px) + static_cast<std::size_t>(u);
  }
};

}  // namespace pharos::sim
