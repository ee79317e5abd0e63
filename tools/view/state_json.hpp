// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "pharos/geometry/target.hpp"
#include "tools/sources/source_table.hpp"

namespace pharos::tools {

/// Where the replay of a log is.
struct ReplayState {
  double position_s = 0.0;  // from the log's first message
  double duration_s = 0.0;
  double speed = 1.0;
  bool playing = true;
  std::int64_t skipped = 0;  // broken pieces of the log
};

/// What the page is told besides the table.
struct ViewContext {
  std::int64_t utc_ns = 0;  // of what is shown
  std::int64_t now_ns = 0;  // the same on the table's clock
  int viewers = 0;
  std::int64_t refused_requests = 0;
  std::optional<ReplayState> replay;
};

/// Everything the page shows at one moment, as one JSON object on one line. Texts of messages are made valid UTF-8.
/// Positions in m, angles in rad, rounded to 1e-6 (1e-9 where sigmas need it).
std::string state_json(const SourceTable& table, const ViewContext& context);

/// Sensor positions of the targets given on the command line, by the target's name.
std::string targets_json(const std::map<std::string, Target>& targets);

}  // namespace pharos::tools
