// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "pharos/geometry/pose.hpp"
#include "pharos/geometry/target.hpp"
#include "tests/integration/cli/program.hpp"

namespace pharos::cli_test {

/// A stationary target with one station, 12 s (OOTX is sent three times), light without noise: the programs' correct
/// results are known.
class ExampleRecording {
 public:
  /// Made once for all tests of the program.
  static const ExampleRecording& get();

  std::string edges() const { return folder_.path("edges.csv.gz"); }
  std::string target() const { return folder_.path("target.csv"); }
  std::string stations() const { return folder_.path("stations.toml"); }
  std::string true_stations() const { return folder_.path("stations_true.toml"); }
  /// The same recording as text.
  std::string edges_text() const;
  const LighthouseFromBody& truth() const { return truth_; }
  const Target& target_as_built() const { return target_; }

  static constexpr const char* kStationId = "BEC08E38";

 private:
  ExampleRecording();

  Folder folder_;
  LighthouseFromBody truth_;
  Target target_;
};

inline const ExampleRecording& recording() { return ExampleRecording::get(); }

/// A solid target with normals; the frustum of tools/sim/scenarios.
std::string solid_target_csv();
/// Four sensors in one plane.
std::string plane_target_csv();

}  // namespace pharos::cli_test
