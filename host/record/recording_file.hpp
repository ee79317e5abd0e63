// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "host/support/unique_fd.hpp"

namespace pharos::host {

/// Of recorded serial streams, and of recorded frames of a camera.
inline constexpr const char* kStreamSuffix = ".phraw";
inline constexpr const char* kFramesSuffix = ".phcam";

/// Creates the next file of a series, `NAME_YYYYMMDDTHHMMSSZ[_N]SUFFIX` of that time, in a directory that is created
/// too. `path`: the file, or the one that could not be created; then errno says why and the result is not valid.
UniqueFd create_recording_file(const std::filesystem::path& directory, const std::string& name,
                               const std::string& suffix, std::int64_t utc_ns, std::filesystem::path& path);

/// Writes everything; false, with errno, where that fails.
bool write_all(int fd, std::span<const std::uint8_t> bytes);

/// The files of a series in the order of their times; `path` itself where it is a file. Empty where there is none.
std::vector<std::filesystem::path> recording_files(const std::filesystem::path& path, const std::string& name,
                                                   const std::string& suffix);

/// Whether `path` is a file of recorded frames, or a directory with some of this camera's.
bool is_frame_recording(const std::filesystem::path& path, const std::string& camera);

/// Names of the recordings of a rig's cameras, left and right.
inline std::string side_name(const std::string& rig, std::size_t side) {
  return rig + (side == 0 ? "-left" : "-right");
}

}  // namespace pharos::host
