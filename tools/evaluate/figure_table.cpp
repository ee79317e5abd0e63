// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluate/figure_table.hpp"

#include <fmt/format.h>

#include <optional>

#include "pharos/base/units.hpp"

namespace pharos::evaluate {
namespace {

std::string line(const std::string& what, const std::string& rotation, const std::string& position) {
  return fmt::format("{:<24}{:>14}{:>14}\n", what, rotation, position);
}

std::string cell(std::optional<double> value, double scale, const char* unit) {
  return value ? fmt::format("{:.4g} {}", *value * scale, unit) : std::string("-");
}

std::string error_line(const std::string& what, std::optional<double> rotation_rad, std::optional<double> position_m) {
  return line(what, cell(rotation_rad, kDegPerRad, "deg"), cell(position_m, kMmPerM, "mm"));
}

std::string consistency_lines(const std::optional<Consistency>& rotation, const std::optional<Consistency>& position) {
  if (!rotation && !position) return "stated sigmas: none\n";
  const auto within = [](const std::optional<Consistency>& half, std::size_t k) {
    return cell(half ? std::optional(half->within[k]) : std::nullopt, 100.0, "%");
  };
  const auto square = [](const std::optional<Consistency>& half) {
    return half ? fmt::format("{:.3g}", half->normalised_square) : std::string("-");
  };
  std::string out;
  for (std::size_t k = 0; k < 3; ++k) {
    out += line(fmt::format("within {} stated sigma", k + 1), within(rotation, k), within(position, k));
  }
  return out + line("mean (error / sigma)^2", square(rotation), square(position));
}

std::string pose_line(const char* what, const Quaternion& q, const Vector3& t) {
  return fmt::format("{:<24}q {:.6f} {:.6f} {:.6f} {:.6f}  t {:.4f} {:.4f} {:.4f} m\n", what, q.w(), q.x(), q.y(),
                     q.z(), t.x(), t.y(), t.z());
}

std::string alignment_lines(const Alignment& alignment) {
  return fmt::format("{:<24}{:.6f} s\n", "time offset", alignment.time_offset_s) +
         pose_line("world (q wxyz)", alignment.world.quaternion(), alignment.world.t) +
         pose_line("body (q wxyz)", alignment.body.quaternion(), alignment.body.t);
}

}  // namespace

std::string figure_table(const Comparison& comparison, const RowCounts& counts, double relative_s) {
  std::string out = fmt::format(
      "{} of {} rows compared; {} refused, {} ambiguous, {} flagged, {} outside of TRUTH, {} in its gaps\n",
      counts.compared, counts.rows, counts.refused, counts.ambiguous, counts.flagged, counts.outside, counts.in_gap);
  if (!comparison.refused.empty()) return out + "no result: " + comparison.refused + '\n';
  const auto& [rotation, position, ate_m, relative_pairs, coverage] = comparison.figures;
  out += fmt::format("{:.1f} % of the common time covered\n\n", 100.0 * coverage);
  out += line("error", "rotation", "position");
  out += error_line("root mean square", rotation.error.rms, position.error.rms);
  out += error_line("median", rotation.error.median, position.error.median);
  out += error_line("95 %", rotation.error.p95, position.error.p95);
  out += error_line("99 %", rotation.error.p99, position.error.p99);
  out += error_line("largest", rotation.error.max, position.error.max);
  out += error_line("RMS about the mean", rotation.spread, position.spread);
  out += error_line(fmt::format("RMS of motion in {:g} s", relative_s), rotation.relative, position.relative);
  out += error_line("after a fit of paths", std::nullopt, ate_m);
  return out + consistency_lines(rotation.consistency, position.consistency) + '\n' +
         alignment_lines(comparison.aligned.alignment);
}

}  // namespace pharos::evaluate
