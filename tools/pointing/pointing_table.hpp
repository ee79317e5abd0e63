// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/table/row_writer.hpp"
#include "host/vision/pointing/measure_panel.hpp"
#include "pharos/pointing/pass.hpp"

namespace pharos::tools {

/// Columns of `pharos line`: those of one image, then what tells how good it is, then a pass' own.
std::vector<std::string> pointing_columns();

/// One image's answer. Without a station the Earth-fixed columns stay empty.
void write_image(host::RowWriter& rows, const std::string& image, const pointing::PanelMeasurement& panel,
                 const pointing::PointingResult& answer, const std::optional<pointing::Geodetic>& station);
/// One image's axis by a method that states neither a sigma nor a plane.
void write_paper_axis(host::RowWriter& rows, const std::string& image, const Vector3& axis_station,
                      const std::optional<double>& square_rad, const std::optional<pointing::Geodetic>& station);
/// An image or a pass without an answer: `reason` is the word after refused_.
void write_pointing_refusal(host::RowWriter& rows, const std::string& image, const std::string& reason);
/// The last row, `pass`. `status` is ok, ambiguous or refused_<reason>.
void write_pass(host::RowWriter& rows, const pointing::PassSolution& answer, pointing::AttitudeLaw law,
                const pointing::Geodetic& station);

}  // namespace pharos::tools
