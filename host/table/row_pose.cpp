// SPDX-License-Identifier: Apache-2.0
#include "host/table/row_pose.hpp"

#include <array>
#include <cstddef>

namespace pharos::host {
namespace {

constexpr std::array kCoordinates = {"rx", "ry", "rz", "tx", "ty", "tz"};
constexpr std::size_t kRotations = 3;

}  // namespace

std::vector<std::string> covariance_columns() {
  std::vector<std::string> columns;
  columns.reserve(kCoordinates.size() * kCoordinates.size());
  for (std::size_t i = 0; i < kCoordinates.size(); ++i) {
    for (std::size_t j = 0; j < kCoordinates.size(); ++j) {
      const std::size_t rotations = (i < kRotations ? 1U : 0U) + (j < kRotations ? 1U : 0U);
      const char* unit = rotations == 2 ? "_rad2" : rotations == 1 ? "_rad_m" : "_m2";
      columns.push_back(std::string("cov_") + kCoordinates[i] + '_' + kCoordinates[j] + unit);
    }
  }
  return columns;
}

}  // namespace pharos::host
