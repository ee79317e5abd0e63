// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/approach/raw/raw_writer.hpp"

#include <algorithm>

#include "host/support/input_error.hpp"
#include "tools/sim/approach/approach_writer.hpp"
#include "tools/sim/approach/raw/raw_source.hpp"

namespace pharos::sim {
namespace {

using host::SourceKind;

bool is_raw(const ApproachSource& source, ApproachLevel level) {
  if (level == ApproachLevel::kMeasurements) return false;
  return level == ApproachLevel::kImages || source.kind == SourceKind::kLighthouse;
}

void refuse_unsimulated(const RawApproach& approach) {
  const ApproachScenario& scenario = approach.scenario;
  for (const ApproachSource& source : scenario.sources) {
    if (!is_raw(source, approach.level)) continue;
    const bool faulty = std::any_of(scenario.faults.begin(), scenario.faults.end(),
                                    [&](const ApproachFault& fault) { return fault.source == source.name; });
    const bool glare = std::any_of(scenario.suns.begin(), scenario.suns.end(), [&](const SunPassage& sun) {
      return std::find(sun.sources.begin(), sun.sources.end(), source.name) != sun.sources.end();
    });
    if (faulty || glare) {
      throw host::InputError(source.name + ": [[fault]] and [[sun]] are of poses; use --level measurements");
    }
  }
  if (!(std::max(0.0, scenario.from_s) < std::min(scenario.motion.duration_s, scenario.to_s))) {
    throw host::InputError("no time is left between --from and --to");
  }
}

// One body has one ring: all that see it see the same.
ApproachScenario with_one_ring(ApproachScenario scenario) {
  const host::TargetFromFeature ring = docking_ring(scenario);
  for (ApproachSource& source : scenario.sources) {
    if (source.kind == SourceKind::kTof || source.kind == SourceKind::kRing2) source.T_target_feature = ring;
  }
  return scenario;
}

void write_source(const RawOutput& output) {
  switch (output.simulator.scenario().sources[output.source].kind) {
    case SourceKind::kLighthouse:
      return write_raw_lighthouse(output);
    case SourceKind::kTof:
      return write_raw_tof(output);
    case SourceKind::kRing2:
      return write_raw_ring2(output);
    case SourceKind::kSlam:
      return write_raw_slam(output);
  }
}

}  // namespace

std::size_t image_count(const RawApproach& approach) {
  if (approach.level != ApproachLevel::kImages) return 0;
  const ApproachSimulator simulator(with_one_ring(approach.scenario), approach.seed);
  std::size_t count = 0;
  for (std::size_t i = 0; i < approach.scenario.sources.size(); ++i) {
    if (approach.scenario.sources[i].kind == SourceKind::kLighthouse) continue;
    const std::vector<ApproachSight> sights = simulator.sights(i);
    count += static_cast<std::size_t>(
        std::count_if(sights.begin(), sights.end(), [](const ApproachSight& at) { return at.sight == Sight::kSeen; }));
  }
  return count;
}

void write_raw_approach(const RawApproach& approach, const std::filesystem::path& folder,
                        const std::function<void()>& written) {
  refuse_unsimulated(approach);
  const ApproachSimulator simulator(with_one_ring(approach.scenario), approach.seed);
  ApproachOutput tables;
  tables.start_s = kRawStart_s;
  for (const ApproachSource& source : approach.scenario.sources) {
    tables.raw.push_back(is_raw(source, approach.level));
  }
  write_approach(simulator, folder, tables);
  for (std::size_t i = 0; i < tables.raw.size(); ++i) {
    if (!tables.is_raw(i)) continue;
    const std::string& name = simulator.scenario().sources[i].name;
    write_source({simulator, i, approach.seed, folder / name, approach.target_file, written});
  }
}

}  // namespace pharos::sim
