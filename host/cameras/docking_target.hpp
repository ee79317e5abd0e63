// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pharos::host {

/// A length of the target and its standard deviation.
struct StatedLength {
  double value_m = 0.0;
  double sigma_m = 0.0;
};

/// A connector in the target's frame T.
struct StatedConnector {
  StatedLength x, y, height;
  std::array<double, 2> size_m{};
};

/// Target description: what is known beforehand of ring, nozzle and connectors; what is absent is found.
struct DockingTarget {
  std::optional<StatedLength> outer_radius, inner_radius, ring_height;
  std::optional<StatedLength> exit_radius, nozzle_distance;
  std::vector<StatedConnector> connectors;
};

/// Deviation of a length that is stated without one: drawings are kept to that.
inline constexpr double kStatedSigma_m = 0.001;

/// Reads a target description (`-`: standard input):
///   [ring] outer_radius_m, inner_radius_m, height_m   [nozzle] exit_radius_m, distance_m
///   [[connector]] x_m, y_m, height_m, size_m = [x, y]
/// each length with an optional `sigma_...` of the same name. Throws InputError naming file, line and key.
DockingTarget read_docking_target(const std::string& path);

/// The same from text; `name` stands for the file in messages.
DockingTarget parse_docking_target(std::string_view text, const std::string& name);

/// The file's text; parse_docking_target reads the same values from it.
std::string docking_target_text(const DockingTarget& file);

}  // namespace pharos::host
