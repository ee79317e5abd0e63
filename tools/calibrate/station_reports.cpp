// SPDX-License-Identifier: Apache-2.0
#include "tools/calibrate/station_reports.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "host/stations/network_file.hpp"
#include "pharos/base/units.hpp"
#include "tools/calibrate/printf_text.hpp"

namespace pharos::tools {
namespace {

using calibrate::StationCalibration;
using calibrate::StationParameter;

// A parameter whose sigma is still nine tenths of its prior one was not observable.
constexpr double kHardlyTold = 0.9;

std::string gauge_text(const StationCalibration& c) {
  std::string text = "station " + std::to_string(c.stations[0].number) + " stands where it was given";
  if (c.up_sigma_rad) text += printf_text("; z is up to %.2f deg (1 sigma)", *c.up_sigma_rad * kDegPerRad);
  return text;
}

std::string scale_text(const StationCalibration& c) {
  return printf_text("scale: from the target's size alone, %.2f %% of every length (1 sigma)", 100.0 * c.scale_sigma);
}

// Names of one group ("station 0 plane x") come together: "all of station 0 plane x", or each.
std::string unobservable_text(const StationCalibration& c) {
  struct Group {
    std::string name, members;
    std::size_t all = 0, unobservable = 0;
  };
  std::vector<Group> groups;
  for (const StationParameter& p : c.parameters) {
    if (!(p.prior_sigma > 0.0)) continue;
    const std::size_t space = p.name.rfind(' ');
    const std::string group = p.name.substr(0, space);
    if (groups.empty() || groups.back().name != group) groups.push_back({group, "", 0, 0});
    ++groups.back().all;
    if (p.sigma <= kHardlyTold * p.prior_sigma) continue;
    ++groups.back().unobservable;
    groups.back().members += p.name.substr(space);
  }
  std::string text;
  for (const Group& group : groups) {
    if (group.unobservable == 0) continue;
    text += (text.empty() ? "" : "; ") +
            (group.unobservable == group.all ? "all of " + group.name : group.name + group.members);
  }
  return text;
}

}  // namespace

std::string stations_text(const StationCalibration& calibration) {
  return "# pharos calibrate stations: " + gauge_text(calibration) + "\n# " + scale_text(calibration) + "\n" +
         host::network_text(calibration.stations);
}

void write_station_parameters(const StationCalibration& calibration, const OutputOptions& options) {
  Output output(options, {"parameter", "prior", "value", "prior_sigma", "sigma", "told"});
  host::RowWriter& rows = output.rows();
  for (const StationParameter& p : calibration.parameters) {
    rows.text(p.name);
    if (p.prior_sigma > 0.0) {
      const double left = p.sigma / p.prior_sigma;
      rows.number(p.prior).number(p.value).number(p.prior_sigma).number(p.sigma);
      rows.number(std::max(1.0 - left * left, 0.0));
    } else {
      rows.none().number(p.value).none().number(p.sigma).none();
    }
    rows.end_row();
  }
  output.finish();
}

void note_stations(const StationCalibration& c) {
  note(printf_text("%.1f s of motion, %zu sweeps; %zu of %zu hits and %zu pieces of motion that do not fit left out%s",
                   c.seconds, c.sweeps, c.hits_left_out, c.hits, c.pieces_left_out,
                   c.from_scratch ? "; stations' poses found from the recording alone" : ""));
  for (std::size_t s = 0; s < c.stations.size(); ++s) {
    const bool first = c.stations[s].generation == network::Generation::kLighthouse1;
    for (std::size_t p = 0; p < network::kPlanes; ++p) {
      const calibrate::PlaneFit& fit = c.fits[s][p];
      note(
          printf_text("station %d plane %s: residuals %.1f arcsec of a sweep's mean, %.1f of a hit about it; %zu "
                      "sweeps, %zu outliers",
                      c.stations[s].number, first ? (p == 0 ? "x" : "y") : (p == 0 ? "a" : "b"),
                      fit.mean_rad * kArcsecPerRad, fit.own_rad * kArcsecPerRad, fit.sweeps, fit.outliers));
    }
  }
  if (!c.converged) note("the adjustment did not settle: look at the residuals before using it");
  note("gauge: " + gauge_text(c));
  note(scale_text(c));
  const std::string unobservable = unobservable_text(c);
  if (!unobservable.empty())
    note("this recording does not tell these one by one, their sigma is near the prior's: " + unobservable);
}

}  // namespace pharos::tools
