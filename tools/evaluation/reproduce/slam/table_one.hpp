// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "tools/evaluation/comparison/comparison.hpp"
#include "tools/evaluation/report/part.hpp"

namespace pharos::tools {

/// Names of the ways in which a sequence is run: "good", "low-enhanced", "low", and the first two with "-no-loops";
/// "good-20-keyframes", "good-15-boards", "low-bm3d": as the paper's section 3 has them.
std::vector<std::string> table_one_runs();

struct TableOneOptions {
  std::vector<double> turns_deg{30.0, 60.0, 90.0, 180.0, 360.0, 720.0};
  std::vector<std::string> runs = table_one_runs();  ///< the selected ones
  int features = 1000;
  bool povray = true;
  bool video_bm3d = false;  ///< the run with BM3D takes its profile for video: a fifth of the time, 0.2 dB less
  std::uint64_t seed = 1;
  std::filesystem::path folder;           ///< for the pictures of figures 3 and 5; empty: none
  std::filesystem::path frames;           ///< of rendered images, of this scenario and seed alone; empty: not kept
  std::function<void(std::size_t)> step;  ///< called with the number of pairs done
};

/// Number of pairs of all runs with these options.
std::size_t table_one_pairs(const TableOneOptions& options);

/// Rows of the table's other turns, with the published figures alone.
std::vector<ComparisonRow> table_one_left_out(bool good_light, const std::vector<double>& turns_deg);

/// Table 1 of paper 004: each turn in good light, and in low light with and without enhancement; from 360 deg on also
/// without loop closing. Rows: estimated turn, attitude RMSE, error of the last attitude, NEES (mean, per degree of
/// freedom), frames without a pose, loops closed.
///
/// A shorter turn is the beginning of a longer one, image by image, so each run processes the longest once and is
/// evaluated at the end of each (SlamSystem::optimised_trajectory). Runs in the same light use the same images; those
/// that `frames` has are not rendered again, so give runs of one light alone with it.
report::PartResult reproduce_table_one(const TableOneOptions& options);

}  // namespace pharos::tools
