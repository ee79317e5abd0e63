// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/table/row_writer.hpp"
#include "pharos/ring2/solve.hpp"

namespace pharos::tools {

/// The columns of `pharos circles`; with `problem` where the input has one.
std::vector<std::string> ring2_columns(bool with_problem);

/// One answer's row. `by_paper`: no covariance, so no sigmas. `one_edge`: OneEdge bits, where images told.
void write_ring2(const ring2::Ring2Estimate& estimate, bool by_paper, std::uint8_t one_edge, host::RowWriter& rows);
/// A refusal's row: everything empty but the status, refused_<reason>.
void write_refusal(const std::string& reason, host::RowWriter& rows);

/// The reason of a refusal in words for people: what it is and what to do.
std::string refusal_text(const std::string& reason);

/// What the ellipses could not tell, as words joined by |.
std::string unobservable_words(std::uint8_t unobservable);

}  // namespace pharos::tools
