// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/table/row_writer.hpp"
#include "pharos/fusion/target_state.hpp"
#include "tools/fuse/truth_errors.hpp"

namespace pharos::tools {

/// Columns of `pharos fuse`; those of errors where there is a truth.
std::vector<std::string> fused_columns(bool truth);

/// One row; fields are empty where the state does not have them.
void write_fused_row(const fusion::TargetState& state, const std::vector<std::string>& names,
                     const std::optional<StateError>& error, bool truth, host::RowWriter& rows);

/// `timestamp tx ty tz qx qy qz qw` and a line's end.
std::string tum_line(const fusion::TargetState& state);

}  // namespace pharos::tools
