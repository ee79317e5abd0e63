// SPDX-License-Identifier: Apache-2.0
#include "tools/plot_pages/calibration_page.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>

#include "host/support/input_error.hpp"
#include "host/table/table_reader.hpp"
#include "host/toml/strict_toml.hpp"
#include "pharos/base/units.hpp"
#include "tools/plot_pages/curve_panel.hpp"

namespace pharos::tools {
namespace {

using host::TomlTable;

constexpr std::size_t kMaxDrawnParameters = 120;
constexpr double kWidth = 960.0;

// White: none; red: positive, blue: negative.
std::string correlation_colour(double correlation) {
  const double size = std::clamp(std::abs(correlation), 0.0, 1.0);
  const auto faded = [size](int full) {
    return static_cast<unsigned>(std::lround(255.0 + size * (full - 255.0))) & 0xFFU;
  };
  std::array<char, 16> text{};
  if (correlation > 0.0) {
    std::snprintf(text.data(), text.size(), "#%02x%02x%02x", faded(176), faded(48), faded(48));
  } else {
    std::snprintf(text.data(), text.size(), "#%02x%02x%02x", faded(31), faded(95), faded(168));
  }
  return text.data();
}

void draw_square(Svg& svg, double left, double top, double side, const std::string& colour) {
  svg.polygon({{left, top}, {left + side, top}, {left + side, top + side}, {left, top + side}}, colour, colour);
}

void add_covariance(HtmlPage& page, const TomlTable& record, const std::string& path) {
  const std::vector<std::string> names = record.texts("parameters");
  const auto covariance = record.rows("covariance", names.size());
  if (names.empty()) {
    page.paragraph("The file holds no covariance.");
    return;
  }
  if (covariance.size() != names.size()) record.fail("covariance", "must have a row for each of the parameters");
  std::vector<double> sigmas;
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!(covariance[i][i] >= 0.0)) throw host::InputError(path + ": covariance: a variance is negative");
    sigmas.push_back(std::sqrt(covariance[i][i]));
    rows.push_back({names[i], shown_number(sigmas[i])});
  }
  page.heading("Covariance");
  const std::size_t drawn = std::min(names.size(), kMaxDrawnParameters);
  const double side = std::min(18.0, 700.0 / static_cast<double>(drawn));
  Svg svg(kWidth, side * static_cast<double>(drawn) + 20.0);
  for (std::size_t i = 0; i < drawn; ++i) {
    for (std::size_t j = 0; j < drawn; ++j) {
      const double scale = sigmas[i] * sigmas[j];
      const double correlation = i == j ? 1.0 : scale > 0.0 ? covariance[i][j] / scale : 0.0;
      draw_square(svg, 10.0 + side * static_cast<double>(j), 10.0 + side * static_cast<double>(i), side,
                  correlation_colour(correlation));
    }
    svg.text({20.0 + side * static_cast<double>(drawn), 10.0 + side * (static_cast<double>(i) + 0.8)}, names[i],
             std::min(11.0, side));
  }
  page.figure(svg, "Correlations: white 0, red towards 1, blue towards -1." +
                       (drawn < names.size() ? " The first " + std::to_string(drawn) + " of " +
                                                   std::to_string(names.size()) + " parameters."
                                             : std::string()));
  page.table({"parameter", "sigma"}, rows);
}

// Nominal places of the sensors, and where they were found, enlarged.
void add_sensors(HtmlPage& page, const std::vector<TomlTable>& sensors) {
  struct Moved {
    std::array<double, 3> from, by;
  };
  std::vector<Moved> moved;
  Extent extent;
  double largest_m = 0.0;
  for (const TomlTable& sensor : sensors) {
    const auto found = sensor.vector<3>("position_m"), nominal = sensor.vector<3>("nominal_m");
    Moved one{nominal, {}};
    for (std::size_t k = 0; k < 3; ++k) {
      one.by[k] = found[k] - nominal[k];
      largest_m = std::max(largest_m, std::abs(one.by[k]));
      extent.add(nominal[k]);
    }
    moved.push_back(one);
  }
  if (moved.empty()) return;
  extent.widen(0.2, 1e-3);
  const double enlarged = largest_m > 0.0 ? 0.1 * (extent.high - extent.low) / largest_m : 1.0;
  page.heading("Displacement of the sensors");
  Svg svg(kWidth, 340.0);
  constexpr std::array<std::pair<std::size_t, std::size_t>, 3> kPlanes = {{{0, 1}, {0, 2}, {1, 2}}};
  constexpr std::array<const char*, 3> kTitles = {"x right, y up", "x right, z up", "y right, z up"};
  for (std::size_t plane = 0; plane < kPlanes.size(); ++plane) {
    const auto [across, up] = kPlanes[plane];
    const Axes axes{60.0 + 310.0 * static_cast<double>(plane),
                    30.0,
                    240.0,
                    240.0,
                    extent.low,
                    extent.high,
                    extent.low,
                    extent.high};
    draw_axes(svg, axes, kTitles[plane], "m");
    for (const Moved& one : moved) {
      const PlotPoint from = axes.at(one.from[across], one.from[up]);
      svg.circle(from, 3.0, "#9a9a9a");
      svg.line(from, axes.at(one.from[across] + enlarged * one.by[across], one.from[up] + enlarged * one.by[up]),
               "#1f5fa8", 2.0);
    }
  }
  page.figure(svg, "Grey: nominal places, body frame. Blue: displacements, " + shown_number(enlarged, 3) +
                       " times as long; the largest is " + shown_number(largest_m * kMmPerM, 3) + " mm on an axis.");
}

// A rotor's sensors.
struct RotorResiduals {
  std::vector<std::array<double, 4>> sensors;  // number, stationary intervals, before and after in arcsec
};

void draw_rotor(Svg& svg, double top, const std::string& title, const RotorResiduals& rotor, double largest_arcsec,
                double max_intervals) {
  const double count = static_cast<double>(rotor.sensors.size());
  const Axes axes{70.0, top + 30.0, std::max(200.0, 26.0 * count), 110.0, 0.0, count, 0.0, largest_arcsec};
  const Axes below{axes.left, top + 165.0, axes.width, 50.0, 0.0, count, 0.0, max_intervals};
  draw_axes(svg, axes, title + ": residual rms, arcsec", "");
  draw_axes(svg, below, "stationary intervals that hit the sensor", "sensor, in order");
  const auto bar = [&](const Axes& in, double x, double width, double value, const char* colour) {
    svg.polygon({in.at(x, 0.0), in.at(x, value), in.at(x + width, value), in.at(x + width, 0.0)}, colour, colour);
  };
  for (std::size_t k = 0; k < rotor.sensors.size(); ++k) {
    const auto& [sensor, intervals, before, after] = rotor.sensors[k];
    const double x = static_cast<double>(k);
    bar(axes, x + 0.15, 0.3, before, "#9a9a9a");
    bar(axes, x + 0.5, 0.3, after, "#1f5fa8");
    bar(below, x + 0.3, 0.4, intervals, "#2f8f4e");
    svg.text({axes.at(x + 0.5, 0.0).x, below.top + below.height + 28.0}, shown_number(sensor), 10.0, "middle");
  }
}

void add_residuals(HtmlPage& page, const std::string& path) {
  host::TableReader table(host::ByteSource(path),
                          {"station_id", "axis", "sensor", "stills", "before_arcsec", "after_arcsec"});
  std::map<std::string, RotorResiduals> rotors;
  double largest_arcsec = 1e-3, max_intervals = 1.0;
  while (table.next()) {
    const std::array<double, 4> one = {table.number(2), table.number(3), table.number(4), table.number(5)};
    rotors["station " + std::string(table.text(0)) + ", axis " + std::string(table.text(1))].sensors.push_back(one);
    largest_arcsec = std::max({largest_arcsec, one[2], one[3]});
    max_intervals = std::max(max_intervals, one[1]);
  }
  page.heading("Coverage and residuals");
  if (rotors.empty()) {
    page.paragraph(path + ": no row.");
    return;
  }
  constexpr double kPitch = 270.0;
  Svg svg(kWidth, kPitch * static_cast<double>(rotors.size()));
  double top = 0.0;
  for (const auto& [name, rotor] : rotors) {
    draw_rotor(svg, top, name, rotor, 1.05 * largest_arcsec, max_intervals);
    top += kPitch;
  }
  page.figure(svg,
              "Grey: before the calibration, blue: after. Green: in how many stationary intervals each sensor was "
              "hit, its coverage.");
}

// A board's points over the image, with their residuals enlarged: where points were, and whether what is left has a
// pattern.
void add_points(HtmlPage& page, const std::string& path, const TomlTable& camera) {
  const auto width_px = static_cast<double>(camera.integer("width_px", 1, 100'000));
  const auto height_px = static_cast<double>(camera.integer("height_px", 1, 100'000));
  host::TableReader table(host::ByteSource(path), {"u_px", "v_px", "du_px", "dv_px"});
  std::vector<std::array<double, 4>> points;
  double square = 0.0;
  while (table.next()) {
    points.push_back({table.number(0), table.number(1), table.number(2), table.number(3)});
    square += points.back()[2] * points.back()[2] + points.back()[3] * points.back()[3];
  }
  page.heading("Coverage and residuals of the image");
  if (points.empty()) {
    page.paragraph(path + ": no point.");
    return;
  }
  const double rms_px = std::sqrt(square / static_cast<double>(points.size()));
  const double enlarged = rms_px > 0.0 ? 0.02 * width_px / rms_px : 1.0;
  const double scale = (kWidth - 20.0) / width_px;
  Svg svg(kWidth, scale * height_px + 20.0);
  const auto at = [scale](double u, double v) { return PlotPoint{10.0 + scale * (u + 0.5), 10.0 + scale * (v + 0.5)}; };
  const PlotPoint first = at(-0.5, -0.5), last = at(width_px - 0.5, height_px - 0.5);
  svg.polygon({first, {last.x, first.y}, last, {first.x, last.y}}, "none", "#404040");
  for (const auto& [u, v, du, dv] : points) {
    svg.circle(at(u, v), 1.5, "#2f8f4e");
    svg.line(at(u, v), at(u + enlarged * du, v + enlarged * dv), "#1f5fa8");
  }
  page.figure(svg, std::to_string(points.size()) + " points (green) over the whole image and their residuals (blue), " +
                       shown_number(enlarged, 3) + " times as long; their root mean square length is " +
                       shown_number(rms_px, 3) + " px.");
}

void add_images(HtmlPage& page, const std::string& path) {
  host::TableReader table(host::ByteSource(path), {"image", "status", "points", "rms_px", "detail"});
  std::map<std::string, int> statuses;
  std::vector<std::vector<std::string>> refused;
  std::vector<std::pair<std::string, std::optional<double>>> used;
  Extent rms;
  rms.add(0.0);
  while (table.next()) {
    const std::string status(table.text(1));
    ++statuses[status];
    if (status != "used") {
      refused.push_back({std::string(table.text(0)), status, std::string(table.text(4))});
      continue;
    }
    used.emplace_back(table.text(0), table.optional_number(3));
    if (used.back().second) rms.add(*used.back().second);
  }
  page.heading("Images");
  std::string counts;
  for (const auto& [status, count] : statuses) {
    counts += (counts.empty() ? "" : ", ") + std::to_string(count) + " " + status;
  }
  page.paragraph(counts.empty() ? path + ": no row." : counts);
  if (!used.empty()) {
    rms.widen(0.0, 1e-6);
    Svg svg(kWidth, 200.0);
    const Axes axes{70.0, 30.0, kWidth - 100.0, 120.0, 0.0, static_cast<double>(used.size()), 0.0, 1.05 * rms.high};
    draw_axes(svg, axes, "residual rms of each image, px", "images used, in order");
    for (std::size_t k = 0; k < used.size(); ++k) {
      const double x = static_cast<double>(k), value = used[k].second.value_or(0.0);
      svg.polygon({axes.at(x + 0.2, 0.0), axes.at(x + 0.2, value), axes.at(x + 0.8, value), axes.at(x + 0.8, 0.0)},
                  "#1f5fa8", "#1f5fa8");
    }
    page.figure(svg, "Residuals of the images that were used.");
  }
  if (!refused.empty()) {
    page.paragraph("Not used, and why:");
    page.table({"image", "status", "reason"}, refused);
  }
}

}  // namespace

void add_calibration(HtmlPage& page, const CalibrationFiles& files) {
  const TomlTable root = TomlTable::parse_file(files.calibration);
  const TomlTable record = root.table_or_empty("calibration");
  const std::vector<TomlTable> sensors = root.tables("sensor");
  if (record.texts("parameters").empty() && sensors.empty()) {
    throw host::InputError(files.calibration +
                           ": no [calibration] with parameters and covariance; give a file of "
                           "`pharos calibrate`");
  }
  if (!files.residuals.empty()) add_residuals(page, files.residuals);
  if (!files.points.empty()) add_points(page, files.points, root);
  if (!files.images.empty()) add_images(page, files.images);
  add_sensors(page, sensors);
  add_covariance(page, record, files.calibration);
}

}  // namespace pharos::tools
