// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pharos::host {

/// A stereo pair on disk.
struct PairName {
  std::string left;
  std::string right;
  double time_s = 0.0;
  std::optional<std::int64_t> stamp_ns;  ///< where the pair's name tells its time
  std::string stem;                      ///< of the left file, for pictures
};

/// Pairs of the images of two folders (by their endings, see has_image_ending) by sorted name. Time: the name where it
/// is a number of 16 to 19 digits (ns), else index / rate. Throws InputError for a folder without images, for different
/// numbers of images, for an image without a namesake where other names are those of both sides (stamps excepted), and
/// for times that do not grow or of which left and right differ by more than half a frame.
///
/// With `alone`, images without a partner are named there and left out instead: an index counts them, stamps are paired
/// within half a frame. Refused where fewer pairs than lone images remain, and where names differ and numbers too.
std::vector<PairName> pair_names(const std::string& left, const std::string& right, double rate_hz,
                                 std::vector<std::string>* alone = nullptr);

/// The same of one directory as `pharos sim stereo` writes it: left/ and right/ in it, or NAME_left.png beside
/// NAME_right.png. Also throws for a left image without its right one, or the reverse.
std::vector<PairName> pair_names_in(const std::string& directory, double rate_hz);

}  // namespace pharos::host
