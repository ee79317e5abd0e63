// SPDX-License-Identifier: Apache-2.0
#include "tools/calibrate/mounting_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "host/files/atomic_file.hpp"
#include "pharos/base/units.hpp"
#include "tools/calibrate/printf_text.hpp"

namespace pharos::tools {
namespace {

using calibrate::MountingCalibration;
using calibrate::MountingFit;

constexpr double kMsPerS = 1000.0;

struct MountingParameter {
  std::string source, name;
  double value = 0.0, sigma = 0.0;
};

void add_pose(std::vector<MountingParameter>& out, const std::string& source, const char* name, const Matrix3& R,
              const Vector3& t, const Matrix6& covariance) {
  const std::array<const char*, 3> axes{"x", "y", "z"};
  const Vector3 turn = rotation_log(R);
  for (int i = 0; i < 3; ++i) {
    out.push_back({source, std::string(name) + " r" + axes[static_cast<std::size_t>(i)] + "_deg", turn[i] * kDegPerRad,
                   std::sqrt(covariance(i, i)) * kDegPerRad});
  }
  for (int i = 0; i < 3; ++i) {
    out.push_back({source, std::string(name) + " t" + axes[static_cast<std::size_t>(i)] + "_mm", t[i] * kMmPerM,
                   std::sqrt(covariance(i + 3, i + 3)) * kMmPerM});
  }
}

std::vector<MountingParameter> parameters_of(const host::Mounting& mounting) {
  std::vector<MountingParameter> out;
  for (const host::SourceMounting& source : mounting.sources) {
    const host::VehicleFromSensor X = source.vehicle_from_sensor();
    add_pose(out, source.name, "T_vehicle_sensor", X.R, X.t, source.T_vehicle_sensor.covariance);
    if (const auto Y = source.target_from_feature()) {
      add_pose(out, source.name, "T_target_feature", Y->R, Y->t, source.T_target_feature->covariance);
    }
    out.push_back(
        {source.name, "time_offset_ms", source.time_offset_s * kMsPerS, source.time_offset_sigma_s * kMsPerS});
  }
  return out;
}

std::string fit_text(const host::SourceMounting& source, const MountingFit& fit) {
  return printf_text(
      "%s: residuals %.3f deg, %.2f mm RMS, %.2f of the variance stated; %zu poses, %zu outliers, "
      "%zu ambiguous, %zu at other times",
      source.name.c_str(), fit.rms_rotation_rad * kDegPerRad, fit.rms_position_m * kMmPerM, fit.chi2_per_freedom,
      fit.used, fit.outliers, fit.ambiguous, fit.outside);
}

std::vector<std::string> messages_of(const MountingCalibration& c) {
  std::vector<std::string> out;
  out.push_back(printf_text("%.1f s of motion; the target turned by %.1f, %.1f, %.1f deg RMS about its axes", c.seconds,
                            c.turn_rad[0] * kDegPerRad, c.turn_rad[1] * kDegPerRad, c.turn_rad[2] * kDegPerRad));
  for (std::size_t i = 0; i < c.fits.size(); ++i) {
    const host::SourceMounting& source = c.mounting.sources[i];
    out.push_back(fit_text(source, c.fits[i]));
    if (c.fits[i].chi2_per_freedom > 1.0) {
      out.push_back(source.name + ": its residuals exceed the covariances that it states, which were enlarged by that");
    }
    if (source.noise_time_s > 0.0) {
      out.push_back(printf_text("%s: the noise of its poses is alike for %.2f s, so that they count as fewer",
                                source.name.c_str(), source.noise_time_s));
    }
    for (const std::string& direction : source.unobservable) {
      out.push_back(source.name + ": not told by this recording, left at its prior: " + direction);
    }
  }
  if (!c.converged) out.emplace_back("the adjustment did not settle: look at the residuals before using it");
  return out;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
  return out;
}

constexpr double kWidth = 900.0, kHeight = 180.0, kMargin = 50.0;
constexpr std::array<const char*, 3> kColours{"#c03030", "#308030", "#3050c0"};

// Points of three components over time; the vertical axis is symmetric about zero.
std::string picture(const MountingFit& fit, bool rotation) {
  const double unit = rotation ? kDegPerRad : kMmPerM;
  const auto value = [&](const calibrate::MountingResidual& r) { return rotation ? r.rotation_rad : r.position_m; };
  double high = 1e-9, begin = 0.0, end = 1.0;
  for (const auto& r : fit.residuals) {
    if (r.used) high = std::max(high, unit * value(r).cwiseAbs().maxCoeff());
  }
  if (!fit.residuals.empty()) {
    begin = fit.residuals.front().time_s;
    end = std::max(fit.residuals.back().time_s, begin + 1e-3);
  }
  std::string out =
      printf_text("<svg width=\"%.0f\" height=\"%.0f\" viewBox=\"0 0 %.0f %.0f\">", kWidth, kHeight, kWidth, kHeight);
  out += printf_text("<line x1=\"%.0f\" y1=\"%.0f\" x2=\"%.0f\" y2=\"%.0f\" stroke=\"#888\"/>", kMargin, kHeight / 2,
                     kWidth, kHeight / 2);
  out += printf_text("<text x=\"2\" y=\"14\" font-size=\"12\">%.3g %s</text>", high, rotation ? "deg" : "mm");
  out += printf_text("<text x=\"2\" y=\"%.0f\" font-size=\"12\">%.3g</text>", kHeight - 4, -high);
  for (const auto& r : fit.residuals) {
    const double x = kMargin + (kWidth - kMargin - 4) * (r.time_s - begin) / (end - begin);
    for (int i = 0; i < 3; ++i) {
      const double y = std::clamp(unit * value(r)[i] / high, -1.0, 1.0);
      out += printf_text("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"1.3\" fill=\"%s\"/>", x,
                         kHeight / 2 - y * (kHeight / 2 - 8), r.used ? kColours[static_cast<std::size_t>(i)] : "#ccc");
    }
  }
  return out + "</svg>\n";
}

}  // namespace

void write_mounting_parameters(const MountingCalibration& calibration, const OutputOptions& options) {
  Output output(options, {"source", "parameter", "value", "sigma"});
  for (const MountingParameter& p : parameters_of(calibration.mounting)) {
    output.rows().text(p.source).text(p.name).number(p.value).number(p.sigma).end_row();
  }
  output.finish();
}

void note_mounting(const MountingCalibration& calibration) {
  for (const std::string& message : messages_of(calibration)) note(message);
}

void write_mounting_report(const MountingCalibration& calibration, const std::string& path) {
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>pharos calibrate mounting</title>\n"
      "<style>body{font-family:sans-serif;max-width:960px}td,th{padding:0 1em;text-align:right}</style></head><body>\n"
      "<h1>Mounting</h1>\n<ul>\n";
  for (const std::string& message : messages_of(calibration)) html += "<li>" + escaped(message) + "</li>\n";
  html += "</ul>\n<table><tr><th>source</th><th>parameter</th><th>value</th><th>sigma</th></tr>\n";
  for (const MountingParameter& p : parameters_of(calibration.mounting)) {
    html += printf_text("<tr><td>%s</td><td>%s</td><td>%.4f</td><td>%.4f</td></tr>\n", p.source.c_str(), p.name.c_str(),
                        p.value, p.sigma);
  }
  html += "</table>\n";
  for (std::size_t i = 0; i < calibration.fits.size(); ++i) {
    html += "<h2>" + calibration.mounting.sources[i].name +
            "</h2>\n<p>Residuals over time in the sensor's frame: x red, y green, z blue; left out grey.</p>\n";
    html += picture(calibration.fits[i], true) + picture(calibration.fits[i], false);
  }
  host::write_file(path, html + "</body></html>\n");
}

}  // namespace pharos::tools
