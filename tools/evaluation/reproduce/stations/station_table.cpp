// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/stations/station_table.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <optional>

#include "host/calibrate/stations/station_calibration.hpp"
#include "pharos/base/units.hpp"
#include "tools/evaluate/position_comparison.hpp"
#include "tools/evaluation/reproduce/stations/positioning_log.hpp"
#include "tools/support/progress.hpp"

namespace pharos::tools {
namespace {

using evaluate::PositionComparison;

struct Figure {
  const char* name;
  double PositionComparison::*value;
};
constexpr std::array<Figure, 5> kFigures{{{"mean", &PositionComparison::mean_m},
                                          {"median", &PositionComparison::median_m},
                                          {"RMS", &PositionComparison::rms_m},
                                          {"95 %", &PositionComparison::p95_m},
                                          {"maximum", &PositionComparison::max_m}}};

std::string millimetres(double value_m) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g", value_m * kMmPerM);
  return text.data();
}

PositionComparison compared(const PositioningLog& log, const evaluate::PositionTrack& track, bool lever_arm) {
  evaluate::PositionOptions options;
  options.marks_s = log.marks_s;
  options.estimate_lever_arm = lever_arm;
  options.epochs_s.emplace();
  for (const auto& beam : log.crossing_beams.samples) options.epochs_s->push_back(beam.time_s);
  return evaluate::compare_positions(track, log.truth, options);
}

void add_rows(const PositioningLog& log, const PositionComparison& logged, const PositionComparison& ours,
              const std::string& geometry, const std::string& remark, std::vector<ComparisonRow>& rows) {
  if (!ours.refused.empty()) {
    rows.push_back({log.name, geometry + ": epochs answered", "%", "99", 0.0, ours.why});
    return;
  }
  if (log.kind == "jitter") {
    rows.push_back({log.name, geometry + ": at rest, RMS about the mean", "mm", millimetres(logged.spread_m),
                    ours.spread_m * kMmPerM, remark});
  } else {
    for (const Figure& figure : kFigures) {
      rows.push_back({log.name, geometry + ": " + figure.name, "mm", millimetres(logged.*figure.value),
                      ours.*figure.value * kMmPerM, remark});
    }
    if (ours.nees_per_dof) rows.push_back({log.name, geometry + ": NEES / 3", "", "1", *ours.nees_per_dof, remark});
    rows.push_back({log.name, geometry + ": rows beyond 5 of their sigmas", "", "<= 0",
                    static_cast<double>(ours.beyond_5_sigmas), "of " + std::to_string(ours.judged)});
  }
  const double answered =
      100.0 * static_cast<double>(ours.epochs_answered) / static_cast<double>(std::max<std::size_t>(1, ours.epochs));
  rows.push_back({log.name, geometry + ": epochs answered", "%", "99", answered,
                  std::to_string(ours.epochs_answered) + " of " + std::to_string(ours.epochs)});
}

// Geometry of a generation, from its first log moved by hand.
struct OwnGeometry {
  network::Stations stations;
  std::string from;
};

std::map<int, OwnGeometry> own_geometries(const std::vector<PositioningLog>& logs) {
  std::map<int, OwnGeometry> out;
  for (const PositioningLog& log : logs) {
    if (log.kind != "move" || out.count(log.generation) > 0) continue;
    calibrate::StationCalibrationInput input;
    input.log = log.light;
    input.stations = log.stations;
    input.target = log.target;
    out[log.generation] = {calibrate::calibrate_stations(input).stations, log.name};
  }
  return out;
}

}  // namespace

StationTable reproduce_stations(const std::string& folder) {
  const std::vector<PositioningLog> logs = read_positioning_logs(folder);
  const std::map<int, OwnGeometry> own = own_geometries(logs);
  StationTable out;
  Progress progress("reproduce stations", "logs", logs.size());
  for (const PositioningLog& log : logs) {
    const PositionComparison logged = compared(log, log.crossing_beams, false);
    const auto add = [&](const std::string& name, const network::Stations& stations, bool lever_arm,
                         const std::string& remark) {
      const evaluate::PositionTrack track = tracked_positions(log, stations);
      const PositionComparison ours = compared(log, track, lever_arm);
      add_rows(log, logged, ours, name, remark, out.rows);
      const std::vector<ResidualCell> cells = residual_map(log, name, stations, track, ours);
      out.residuals.insert(out.residuals.end(), cells.begin(), cells.end());
    };
    add("geometry as logged", log.stations, false, "");
    const auto geometry = own.find(log.generation);
    if (geometry != own.end()) {
      add("own geometry", geometry->second.stations, true,
          geometry->second.from == log.name ? "learnt from this log" : "learnt from " + geometry->second.from);
    }
    progress.step();
  }
  return out;
}

}  // namespace pharos::tools
