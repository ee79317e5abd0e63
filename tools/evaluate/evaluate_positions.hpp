// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tools/support/output.hpp"

namespace CLI {
class App;
}

namespace pharos::tools {

/// Options of a TRUTH of positions alone.
struct PositionChoices {
  std::vector<double> clock_marks;  // two, or none
  double clock_window_ms = 100.0;
  std::string lever_arm;  // estimate, or empty
  std::string epochs;     // file, or empty
};

void add_position_options(CLI::App& command, PositionChoices& choices);

/// ESTIMATE against positions: one row; the exit code.
int evaluate_positions(const std::string& estimate, const std::string& truth, const PositionChoices& choices,
                       const OutputOptions& output);

}  // namespace pharos::tools
