// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "tools/evaluation/comparison/comparison.hpp"

namespace pharos::tools::report {

/// What a part is run with.
struct PartSettings {
  bool quick = false;  ///< fewer and shorter runs: the whole report in less than three minutes
  std::uint64_t seed = 1;
  bool rays = false;  ///< paper 004's images by own rays, without gloss, in a tenth of POV-Ray's time
};

/// A picture that a part wrote into its folder: SVG or PNG.
struct Picture {
  std::string label;    ///< of the figure: "figure 7"
  std::string caption;  ///< what is seen, one sentence
  std::string file;     ///< name within the part's folder
};

/// What a part found. A row belongs to the table or figure with which its `item` begins.
struct PartResult {
  std::vector<ComparisonRow> rows;
  std::vector<Picture> pictures;
};

/// One run of the report: some tables and figures of one paper that are computed together.
struct Part {
  std::string id;                                           ///< a word, also the name of its folder
  std::function<std::string(const PartSettings&)> command;  ///< how to have the same rows by themselves
  /// Writes its pictures into `folder`, which is there. Throws host::InputError.
  std::function<PartResult(const PartSettings&, const std::filesystem::path& folder)> run;
};

}  // namespace pharos::tools::report
