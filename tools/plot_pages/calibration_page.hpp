// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tools/plot_pages/html_page.hpp"

namespace pharos::tools {

/// Files of one calibration. The tables are those of `pharos calibrate`; empty: none.
struct CalibrationFiles {
  std::string calibration;  // TOML, with [calibration] parameters and covariance
  std::string residuals;    // --residuals of `calibrate lighthouse`
  std::string images;       // --images of `calibrate camera` and `calibrate stereo`
  std::string points;       // --points of `calibrate camera`
};

/// Sigmas and correlations of the parameters, displacements of the sensors, and, from the tables, coverage and
/// residuals of each rotor and sensor, or those of
/// a board's points over the image and what became of each image. Throws host::InputError for files that are none of
/// these.
void add_calibration(HtmlPage& page, const CalibrationFiles& files);

}  // namespace pharos::tools
