// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/lighthouse/flight_pictures.hpp"

#include "tools/plot/curves.hpp"

namespace pharos::tools {
namespace {

template <class Value>
Curve curve_of(const char* name, const char* colour, const FlightSeries& series, Value&& value) {
  Curve curve{name, colour, {}};
  for (const FlightPoint& point : series) curve.points.push_back(value(point));
  return curve;
}

// One coordinate over x: truth below, the estimates above it.
CurvePanel trajectory(const char* title, int axis, const FlightSeries& theirs, const FlightSeries& ours) {
  const auto estimate = [axis](const FlightPoint& p) { return PlotPoint{p.estimate.t.x(), p.estimate.t[axis]}; };
  const auto truth = [axis](const FlightPoint& p) { return PlotPoint{p.truth.t.x(), p.truth.t[axis]}; };
  return {title,
          {curve_of("truth", "#909090", theirs, truth), curve_of("theirs", "#e1501e", theirs, estimate),
           curve_of("ours", "#00a060", ours, estimate)}};
}

// One kind of error over time; that of another minimum would hide all others, so theirs stand in a panel of their own.
template <class Value>
void add_errors(std::vector<CurvePanel>& panels, const std::string& what, const FlightSeries& theirs,
                const FlightSeries& ours, Value&& value) {
  const auto error = [&value](const FlightPoint& p) {
    return PlotPoint{p.time_s, value(error_of(p.estimate, p.truth))};
  };
  const auto bound = [&value](const FlightPoint& p) { return PlotPoint{p.time_s, 3.0 * value(p.sigma)}; };
  panels.push_back({what + ", theirs", {curve_of("theirs", "#e1501e", theirs, error)}});
  panels.push_back(
      {what + ", ours",
       {curve_of("three stated sigmas", "#b0b0b0", ours, bound), curve_of("ours", "#00a060", ours, error)}});
}

}  // namespace

void add_flight_pictures(const FlightSeries& theirs, const FlightSeries& ours, const std::filesystem::path& folder,
                         report::PartResult& result) {
  write_curves((folder / "figure6.svg").string(),
               {trajectory("z (ahead), m", 2, theirs, ours), trajectory("y (down), m", 1, theirs, ours)},
               "x (right), m");
  result.pictures.push_back({"figure 6", "run 1 in the lighthouse frame, from above and from behind", "figure6.svg"});
  std::vector<CurvePanel> panels;
  add_errors(panels, "rotation error, deg", theirs, ours, [](const PoseError& e) { return e.rotation_deg; });
  add_errors(panels, "position error, mm", theirs, ours, [](const PoseError& e) { return e.position_mm; });
  write_curves((folder / "figure7.svg").string(), panels, "time, s");
  result.pictures.push_back({"figure 7", "run 1: errors (25) over time", "figure7.svg"});
}

}  // namespace pharos::tools
