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
  std::optional<std::int64_t> stamp_ns;  ///< if the pair's name is its time
  std::string stem;                      ///< of the left file, for pictures
};

/// Pairs of the images in two folders (by their endings, see has_image_ending) by sorted name. Time: the name if it is
/// a number of 16 to 19 digits (ns), otherwise index / rate. Throws InputError for a folder without images, for
/// different numbers of images, for an image without a partner if the sides have other names in common (time stamps
/// excepted), and for times that do not increase, or whose left and right differ by more than half a frame.
///
/// With `alone`, images without a partner are left out and appended there: they count for the index, and time stamps
/// are paired within half a frame. It still throws if fewer pairs than such images remain, and if both the names and
/// the numbers of images differ.
std::vector<PairName> pair_names(const std::string& left, const std::string& right, double rate_hz,
                                 std::vector<std::string>* alone = nullptr);

/// The same for one directory, as `pharos sim stereo` writes it: with left/ and right/, or with NAME_left.png and
/// NAME_right.png. Also throws for an image of one side without that of the other.
std::vector<PairName> pair_names_in(const std::string& directory, double rate_hz);

}  // namespace pharos::host
