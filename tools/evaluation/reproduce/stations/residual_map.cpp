// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/stations/residual_map.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "pharos/base/units.hpp"

namespace pharos::tools {
namespace {

using evaluate::PositionSample;

constexpr double kCell_deg = 5.0;
constexpr double kNearTracked_s = 0.02;  // an attitude changes by less than a degree within it
constexpr double kMaxTruthGap_s = 0.05;

const PositionSample* nearest(const evaluate::PositionTrack& track, double time_s) {
  const auto after = std::lower_bound(track.samples.begin(), track.samples.end(), time_s,
                                      [](const PositionSample& s, double t) { return s.time_s < t; });
  const PositionSample* best = nullptr;
  if (after != track.samples.end()) best = &*after;
  if (after != track.samples.begin() &&
      (best == nullptr || std::abs((after - 1)->time_s - time_s) < std::abs(best->time_s - time_s))) {
    best = &*(after - 1);
  }
  return best != nullptr && std::abs(best->time_s - time_s) <= kNearTracked_s ? best : nullptr;
}

// What a sweep leaves, and the direction from the station.
struct Left {
  double residual_rad = 0.0;
  double azimuth_deg = 0.0, elevation_deg = 0.0;
};

std::optional<Left> left_of(const network::PlaneSweep& sweep, const network::Station& station, const Target& target,
                            const network::WorldFromBody& body) {
  const auto T_station_world = station.T_world_station->inverse();
  Left out;
  int count = 0;
  for (const network::Hit& hit : sweep.hits) {
    const SensorPlacement* sensor = find_sensor(target, hit.sensor);
    if (sensor == nullptr) continue;
    const Vector3 p = T_station_world * (body * sensor->position_m);
    if (!(p.z() > 0.0)) return std::nullopt;
    out.residual_rad += hit.angle_rad - network::raw_angle(station, sweep.plane, p);
    ++count;
  }
  if (count == 0 || !std::isfinite(out.residual_rad)) return std::nullopt;
  out.residual_rad /= count;
  const Vector3 p = T_station_world * body.t;
  out.azimuth_deg = std::atan2(p.x(), p.z()) * kDegPerRad;
  out.elevation_deg = std::atan2(p.y(), std::hypot(p.x(), p.z())) * kDegPerRad;
  return out;
}

int cell_of(double angle_deg) { return static_cast<int>(std::floor(angle_deg / kCell_deg)); }

std::string plane_name(network::Generation generation, std::size_t plane) {
  if (generation == network::Generation::kLighthouse1) return plane == 0 ? "x" : "y";
  return plane == 0 ? "a" : "b";
}

}  // namespace

std::vector<ResidualCell> residual_map(const PositioningLog& log, const std::string& geometry,
                                       const network::Stations& stations, const evaluate::PositionTrack& tracked,
                                       const evaluate::PositionComparison& comparison) {
  std::map<std::tuple<std::size_t, std::size_t, int, int>, ResidualCell> cells;
  if (!comparison.refused.empty() || comparison.stationary) return {};
  for (const network::PlaneSweep& sweep : calibrate::plane_sweeps(log.light, stations)) {
    const double time_s = sweep.time_s();
    const PositionSample* attitude = nearest(tracked, time_s);
    const auto truth = evaluate::position_at(log.truth.samples, comparison.truth_time(time_s), kMaxTruthGap_s);
    if (attitude == nullptr || !attitude->R_world_body || !truth) continue;
    const Matrix3& R = *attitude->R_world_body;
    const network::WorldFromBody body{
        R, comparison.R_estimate_truth * *truth + comparison.t_estimate_truth_m - R * comparison.lever_m};
    const network::Station& station = stations[sweep.station];
    const auto left = left_of(sweep, station, log.target, body);
    if (!left) continue;
    const int azimuth = cell_of(left->azimuth_deg), elevation = cell_of(left->elevation_deg);
    ResidualCell& cell = cells[{sweep.station, sweep.plane, azimuth, elevation}];
    cell.log = log.name;
    cell.geometry = geometry;
    cell.station = station.number;
    cell.plane = plane_name(station.generation, sweep.plane);
    cell.azimuth_deg = (azimuth + 0.5) * kCell_deg;
    cell.elevation_deg = (elevation + 0.5) * kCell_deg;
    ++cell.sweeps;
    cell.mean_rad += left->residual_rad;
    cell.rms_rad += left->residual_rad * left->residual_rad;
  }
  std::vector<ResidualCell> out;
  for (auto& [key, cell] : cells) {
    const auto n = static_cast<double>(cell.sweeps);
    cell.mean_rad /= n;
    cell.rms_rad = std::sqrt(cell.rms_rad / n);
    out.push_back(std::move(cell));
  }
  return out;
}

void write_residual_map(const std::vector<ResidualCell>& cells, const std::string& path) {
  OutputOptions options;
  options.path = path;
  Output output(options, {"log", "geometry", "station", "plane", "azimuth_deg", "elevation_deg", "sweeps",
                          "mean_arcsec", "rms_arcsec"});
  for (const ResidualCell& cell : cells) {
    output.rows().text(cell.log).text(cell.geometry).integer(cell.station).text(cell.plane);
    output.rows().number(cell.azimuth_deg).number(cell.elevation_deg).integer(static_cast<std::int64_t>(cell.sweeps));
    output.rows().number(cell.mean_rad * kArcsecPerRad).number(cell.rms_rad * kArcsecPerRad).end_row();
  }
  output.finish();
}

}  // namespace pharos::tools
