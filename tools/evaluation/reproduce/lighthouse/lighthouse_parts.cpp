// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/lighthouse/lighthouse_parts.hpp"

namespace pharos::tools {
namespace {

constexpr int kQuickSets = 10;
constexpr double kQuickSet_s = 12.0;  // OOTX is received twice within 9 s
constexpr int kQuickRuns = 3;
constexpr double kQuickRun_s = 15.0;
constexpr CalibrationSession kQuickCalibration = {12, 1.0};

std::string command(const report::PartSettings& settings) {
  return std::string("pharos reproduce lighthouse") + (settings.quick ? " --quick" : "") + " --seed " +
         std::to_string(settings.seed);
}

report::PartResult sets(const report::PartSettings& settings, const std::filesystem::path& folder) {
  StaticSetsOptions options;
  options.seed = settings.seed;
  if (settings.quick) make_quick(options);
  return reproduce_static_sets(options, folder);
}

report::PartResult flights(const report::PartSettings& settings, const std::filesystem::path& folder) {
  DynamicRunsOptions options;
  options.seed = settings.seed;
  if (settings.quick) make_quick(options);
  return reproduce_dynamic_runs(options, folder);
}

}  // namespace

void make_quick(StaticSetsOptions& sets) {
  sets.sets = kQuickSets;
  sets.set_s = kQuickSet_s;
}

void make_quick(DynamicRunsOptions& runs) {
  runs.runs = kQuickRuns;
  runs.run_s = kQuickRun_s;
  runs.calibration = kQuickCalibration;
}

std::vector<report::Part> lighthouse_parts() {
  return {{"lighthouse-sets", command, sets}, {"lighthouse-flights", command, flights}};
}

}  // namespace pharos::tools
