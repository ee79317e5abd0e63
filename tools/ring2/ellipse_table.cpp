// SPDX-License-Identifier: Apache-2.0
#include "tools/ring2/ellipse_table.hpp"

#include <cmath>
#include <unordered_map>
#include <utility>

#include "host/table/table_reader.hpp"

namespace pharos::tools {
namespace {

enum Column : std::size_t { kView, kFeature, kCx, kCy, kA, kB, kTheta };

// Sizes and places beyond these are no image's; squares of them stay numbers.
constexpr double kLargest_px = 1e6;
constexpr double kMin_px = 1e-3;

std::size_t choice(const host::TableReader& table, Column column, const char* first, const char* second) {
  const std::string_view word = host::trimmed(table.text(column));
  if (word == first) return 0;
  if (word == second) return 1;
  table.fail(column, host::quoted(word) + " is neither " + first + " nor " + second);
}

double within(const host::TableReader& table, std::size_t column, double minimum, double maximum, const char* what) {
  const double value = table.number(column);
  if (!(value >= minimum && value <= maximum)) table.fail(column, what);
  return value;
}

ring2::Contour contour_in(const host::TableReader& table, std::optional<std::size_t> sigma,
                          std::optional<std::size_t> points) {
  ellipse::Ellipse e;
  e.cx_px = within(table, kCx, -kLargest_px, kLargest_px, "is outside of any image");
  e.cy_px = within(table, kCy, -kLargest_px, kLargest_px, "is outside of any image");
  e.a_px = within(table, kA, kMin_px, kLargest_px, "must be a semi-axis of more than 0.001 px");
  e.b_px = within(table, kB, kMin_px, kLargest_px, "must be a semi-axis of more than 0.001 px");
  e.theta_rad = within(table, kTheta, -10.0, 10.0, "must be an angle in radians");
  e = ellipse::normalised(e);
  double sigma_px = kUsualSigma_px;
  double count = ellipse::perimeter_px(e);
  if (sigma && !table.empty(*sigma)) {
    sigma_px = within(table, *sigma, 1e-6, 1e3, "must be the deviation of one edge point, above 1e-6 px");
  }
  if (points && !table.empty(*points)) count = within(table, *points, 5.0, 1e9, "must be at least 5 edge points");
  return ring2::contour_of(e, sigma_px, count);
}

}  // namespace

EllipseTable read_ellipse_table(host::ByteSource source) {
  host::TableReader table(std::move(source), {"view", "feature", "cx_px", "cy_px", "a_px", "b_px", "theta_rad"});
  const std::optional<std::size_t> problem = table.find_optional("problem");
  const std::optional<std::size_t> sigma = table.find_optional("sigma_px");
  const std::optional<std::size_t> points = table.find_optional("points");
  EllipseTable out;
  out.has_problems = problem.has_value();
  std::unordered_map<std::string, std::size_t> places;
  while (table.next()) {
    const std::string name = problem ? std::string(host::trimmed(table.text(*problem))) : std::string();
    const auto [place, fresh] = places.try_emplace(name, out.problems.size());
    if (fresh) out.problems.push_back({name, {}});
    const std::size_t view = choice(table, kView, "left", "right");
    const std::size_t feature = choice(table, kFeature, "ring", "nozzle");
    std::optional<ring2::Contour>& slot = out.problems[place->second].contours[view][feature];
    if (slot) table.fail_row("this view's ellipse of that feature was given before; one of each");
    slot = contour_in(table, sigma, points);
  }
  return out;
}

}  // namespace pharos::tools
