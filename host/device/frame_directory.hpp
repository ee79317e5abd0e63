// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "host/device/depth_frame.hpp"

namespace pharos::host {

/// A directory of recorded frames, as `pharos sim tof` writes it: NNNN_intensity.png and NNNN_depth.png (16 bits), or
/// NNNN_abcy16.raw, in the order of their numbers. All formats of read_grey_image are accepted: intensities of 8 or 16
/// bits, grey or colour (luma); depths grey and of 16 bits.
class FrameDirectory {
 public:
  /// Throws InputError if there is no frame, or one without its intensity or depth.
  explicit FrameDirectory(const std::string& path);

  std::size_t frames() const { return entries_.size(); }
  /// The part of the file's name before `_`.
  const std::string& name(std::size_t index) const { return entries_[index].name; }
  /// Reads sizes and pixels of one frame. `width`, `height`: those of the camera; throws InputError for files of
  /// another size, and for files that cannot be read. Returns the intensity's file if its luma was used.
  std::string read(std::size_t index, std::int32_t width_px, std::int32_t height_px, DepthFrame& frame) const;

 private:
  struct Entry {
    std::string name;
    std::uint64_t number = 0;
    bool raw = false;
    std::string intensity, depth;  // files
  };
  Entry& entry_of(const std::string& name, std::uint64_t number);

  std::filesystem::path folder_;
  std::vector<Entry> entries_;                 // by number
  std::map<std::string, std::size_t> places_;  // used while the directory is read
};

}  // namespace pharos::host
