// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/images/grey_image.hpp"
#include "host/vision/slam/slam_system.hpp"

namespace pharos::tools {

/// The upper 8 of 16 bits a pixel: the input of ORB.
std::vector<std::uint8_t> eight_bits(const host::GreyImage& image);

/// The map's points as a PLY file of ASCII vertices: x y z in metres, observers.
void write_map_ply(const std::string& path, const std::vector<slam::SlamPoint>& points);

/// Memory in use during the run.
struct MemoryAt {
  std::size_t pair = 0;
  std::int64_t resident_kib = 0;
};

/// Counts and times of the command itself.
struct RunFigures {
  int unreadable = 0;              // pairs that could not be read, or of another size
  int without_partner = 0;         // images
  std::vector<double> light_ms;    // of a pair: enhancement, or only conversion to 8 bits
  std::vector<double> to_pose_ms;  // the same and tracking, and mapping where there are no threads
  std::vector<MemoryAt> memory;
};

/// Records the memory in use when `done` of `all` pairs are a quarter, a half, three quarters or all of them.
void note_quarter(std::size_t done, std::size_t all, RunFigures& figures);

/// Figures of a run as one JSON object. Throws InputError where it cannot be written.
void write_slam_report(const std::string& path, const slam::SlamSystem& system, const RunFigures& figures);

/// DIR/STEM_slam.png: features of the last pair (mono, stereo, of the map) over the rectified left image, masked areas
/// tinted.
void write_slam_overlay(const std::string& folder, const std::string& stem, const slam::SlamSystem& system);

}  // namespace pharos::tools
