// SPDX-License-Identifier: Apache-2.0
#include "tools/calibrate/reports.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/base/units.hpp"
#include "tools/calibrate/printf_text.hpp"
#include "tools/support/words.hpp"

namespace pharos::tools {
namespace {

using calibrate::LighthouseCalibration;
using calibrate::Parameter;
using calibrate::SensorFit;

// A parameter whose sigma is still nine tenths of its prior one was not observable.
constexpr double kUnobservable = 0.9;

double rms(const std::vector<SensorFit>& fits, double SensorFit::*member) {
  double square = 0.0;
  double count = 0.0;
  for (const SensorFit& fit : fits) {
    square += fit.*member * fit.*member * fit.intervals;
    count += fit.intervals;
  }
  return count > 0.0 ? std::sqrt(square / count) : 0.0;
}

void note_unobservable(const LighthouseCalibration& calibration) {
  std::string unobservable;
  for (const Parameter& parameter : calibration.bundle.parameters) {
    if (parameter.prior_sigma > 0.0 && parameter.sigma > kUnobservable * parameter.prior_sigma) {
      unobservable += (unobservable.empty() ? "" : ", ") + parameter.name;
    }
  }
  if (!unobservable.empty()) note("these recordings cannot tell, left at the prior: " + unobservable);
}

void note_scale(const LighthouseCalibration& calibration) {
  const double percent = 100.0 * calibration.bundle.scale_sigma;
  if (calibration.scale_measured) {
    note(printf_text("scale measured: the target's size is known to %.3f %% (1 sigma)", percent));
  } else {
    note(printf_text(
        "scale = \"prior\": angles do not tell a target's size, it stays the nominal one to %.3f %% (1 sigma), part "
        "of every range's sigma; give --length",
        percent));
  }
}

}  // namespace

void write_parameters(const LighthouseCalibration& calibration, const OutputOptions& options) {
  Output output(options, {"parameter", "prior", "value", "prior_sigma", "sigma", "told"});
  host::RowWriter& rows = output.rows();
  for (const Parameter& parameter : calibration.bundle.parameters) {
    rows.text(parameter.name);
    if (parameter.prior_sigma > 0.0) {
      const double left = parameter.sigma / parameter.prior_sigma;
      rows.number(parameter.prior).number(parameter.value).number(parameter.prior_sigma).number(parameter.sigma);
      rows.number(std::max(1.0 - left * left, 0.0));
    } else {
      rows.none().number(parameter.value).none().number(parameter.sigma).none();
    }
    rows.end_row();
  }
  output.finish();
}

void write_residuals(const LighthouseCalibration& calibration, const OutputOptions& options) {
  Output output(options, {"station_id", "axis", "sensor", "stills", "before_arcsec", "after_arcsec"});
  host::RowWriter& rows = output.rows();
  for (const SensorFit& fit : calibration.fits) {
    const char axis = name_of(fit.axis);
    rows.text(station_id_text(calibration.bundle.unknowns.station[fit.station].id)).text({&axis, 1});
    rows.integer(fit.sensor).integer(fit.intervals);
    rows.number(fit.before_rad * kArcsecPerRad).number(fit.after_rad * kArcsecPerRad).end_row();
  }
  output.finish();
}

void note_outcome(const LighthouseCalibration& calibration) {
  note(printf_text(
      "%zu stills in %zu poses; %zu without a sure pose left out, %zu mean angles that fit no rigid body struck",
      calibration.intervals, calibration.poses, calibration.intervals_unsolved, calibration.bearings_rejected));
  if (calibration.unknown_sensors > 0) {
    note(printf_text("%zu sensors in the recordings that the target has not: left out", calibration.unknown_sensors));
  }
  note(printf_text("residual rms %.2f arcsec before, %.2f after; %.2f of it beyond the noise of the means",
                   rms(calibration.fits, &SensorFit::before_rad) * kArcsecPerRad,
                   rms(calibration.fits, &SensorFit::after_rad) * kArcsecPerRad,
                   calibration.unmodelled_rad * kArcsecPerRad));
  if (!calibration.bundle.converged) note("the adjustment did not settle: look at the residuals before using it");
  note_scale(calibration);
  note_unobservable(calibration);
}

}  // namespace pharos::tools
