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

/// What a row has beside the estimate.
struct Ring2Row {
  bool by_paper = false;      // no covariance, so no sigmas
  std::uint8_t one_edge = 0;  // OneEdge bits, where images told
  double time_s = 0.0;        // in a line of TUM: the problem's number
};

/// One answer's row. Its pose (TUM, covariance) is that of host::ring2_pose, in the rig's frame; none where the
/// ellipses do not tell the ring's position.
void write_ring2(const ring2::Ring2Estimate& estimate, const Ring2Row& row, host::RowWriter& rows);
/// A refusal's row: everything empty but the status, refused_<reason>.
void write_refusal(const std::string& reason, host::RowWriter& rows);

/// The reason of a refusal in words for people: what it is and what to do.
std::string refusal_text(const std::string& reason);

/// What the ellipses could not tell, as words joined by |.
std::string unobservable_words(std::uint8_t unobservable);

}  // namespace pharos::tools
