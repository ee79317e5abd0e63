// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace pharos::tools {

/// A stereo pair on disk.
struct PairName {
  std::string left;
  std::string right;
  double time_s = 0.0;
  std::string stem;  ///< of the left file, for pictures
};

/// Pairs of the PNG and PGM images of two folders by sorted name. Time: the name where it is a number of 16 to 19
/// digits (ns), else index / rate. Throws InputError for a folder without images, for different numbers of images, and
/// for times that do not grow or of which left and right differ by more than half a frame.
std::vector<PairName> pair_names(const std::string& left, const std::string& right, double rate_hz);

}  // namespace pharos::tools
