// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "host/mounting/source_table.hpp"
#include "pharos/fusion/measurement.hpp"
#include "tools/fuse/fuse_settings.hpp"

namespace pharos::tools {

/// A pose of any source, on the vehicle's clock.
struct ArrivedPose {
  double arrival_s = 0.0;  // its own time where the table does not say more
  fusion::Measurement measurement;
};

/// All sources' poses by arrival, and the fusion's settings.
struct FusedTables {
  fusion::Settings settings;
  std::vector<std::string> names;  // of the sources
  std::vector<ArrivedPose> poses;
  std::size_t refused = 0;  // rows without a pose
};

/// Reads `[NAME=]TABLE` arguments; without NAME the file's name up to its first dot is the source's. `rate_hz` is that
/// of tables that count frames. Throws host::InputError: a source that the mounting does not have, one given twice,
/// more than fusion::kMaxSources, a table without a pose, settings that no rig has.
FusedTables read_fused_tables(const std::vector<std::string>& tables, const host::Mounting& mounting,
                              const FuseChoices& choices, const host::SourceTableChoice& table_choice);

}  // namespace pharos::tools
