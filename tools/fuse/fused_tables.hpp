// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "host/mounting/source_table.hpp"

namespace pharos::tools {

/// A pose of any source.
struct ArrivedPose {
  double arrival_s = 0.0;  // on the vehicle's clock; its own time where the table does not say more
  std::size_t source = 0;
  host::SourceRow row;
};

/// All sources' poses by arrival.
struct FusedTables {
  std::vector<host::SourceMounting> sources;
  std::vector<ArrivedPose> poses;
  std::size_t refused = 0;  // rows without a pose
};

/// Reads `[NAME=]TABLE` arguments; without NAME the file's name up to its first dot is the source's. Throws
/// host::InputError: a source that the mounting does not have, one given twice, a table without a pose, a time beyond
/// 4e9 s.
FusedTables read_fused_tables(const std::vector<std::string>& tables, const host::Mounting& mounting,
                              const host::SourceTableChoice& table_choice);

}  // namespace pharos::tools
