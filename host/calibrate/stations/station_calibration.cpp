// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/stations/station_calibration.hpp"

#include <algorithm>
#include <cmath>

#include "host/calibrate/stations/motion_start.hpp"
#include "host/calibrate/stations/station_report.hpp"
#include "host/calibrate/stations/station_start.hpp"
#include "host/calibrate/stations/sweep_selection.hpp"
#include "host/support/input_error.hpp"
#include "pharos/geometry/rotation.hpp"

namespace pharos::calibrate {
namespace {

using network::Stations;
using network::StationSigmas;

// What the tracker is told of stations that were given or found (station_start), and of adjusted ones.
constexpr StationSigmas kStart{0.05, 0.0, 0.006}, kAdjusted{0.01, 0.0, 0.001};
constexpr std::size_t kMinHits = 200;  // of a station
constexpr double kMinMotion_s = 3.0;   // with two stations at once
constexpr double kMinSpread_m = 0.05;  // of the target's positions, the second of three, 1 sigma
constexpr double kMaxLeftOut = 0.15;   // of the hits within the motion
constexpr SelectionGates kWide{2e-3, 50e-3}, kNarrow{1e-3, 10e-3};

// The stations of the file that were heard.
Stations heard_stations(const StationCalibrationInput& input) {
  Stations heard;
  for (const network::Station& station : input.stations) {
    const auto hits = std::count_if(input.log.hits.begin(), input.log.hits.end(), [&](const NetworkHit& hit) {
      return hit.station == station.number && find_sensor(input.target, hit.hit.sensor) != nullptr;
    });
    if (static_cast<std::size_t>(hits) >= kMinHits) heard.push_back(station);
  }
  if (heard.size() < 2) {
    throw host::InputError(input.log.name + ": light of " + std::to_string(heard.size()) +
                           " of the stations; at least two are needed, each with " + std::to_string(kMinHits) +
                           " hits of the target's sensors");
  }
  return heard;
}

std::string motion_text(double seconds) {
  std::string text = std::to_string(std::lround(10.0 * seconds));
  if (text.size() < 2) text = "0" + text;
  return text.insert(text.size() - 1, ".") + " s";
}

// The motion with the stations' given poses, or with poses found from the recording.
void start(const std::vector<network::PlaneSweep>& sweeps, const StationCalibrationInput& input, StationUnknowns& at,
           bool& from_scratch) {
  const bool posed = std::all_of(at.stations.begin(), at.stations.end(),
                                 [](const network::Station& station) { return station.T_world_station.has_value(); });
  TrackedMotion motion;
  if (posed) motion = track_motion(sweeps, at.stations, at.target, kStart);
  from_scratch = motion.seconds() < kMinMotion_s;
  if (from_scratch) {
    start_stations(sweeps, at.target, input.log.name, at.stations);
    motion = track_motion(sweeps, at.stations, at.target, kStart);
  }
  if (motion.seconds() < kMinMotion_s) {
    throw host::InputError(input.log.name + ": two stations and the target agree for " + motion_text(motion.seconds()) +
                           " only; carry the target for a minute where two stations see it");
  }
  at.motion = std::move(motion.pieces);
}

void require_motion(const StationUnknowns& at, const std::string& name) {
  const Spread spread = spread_of(at);
  if (spread.sigma_m[1] < kMinSpread_m) {
    throw host::InputError(name + ": the target was hardly moved (" +
                           std::to_string(std::lround(1000.0 * spread.sigma_m[1])) +
                           " mm across, 1 sigma); carry it around in all directions");
  }
}

// Another target's sensors, or stations of another room.
void require_fit(const StationCalibration& calibration, const std::string& name) {
  const auto hits = static_cast<double>(calibration.hits);
  if (static_cast<double>(calibration.hits_left_out) <= kMaxLeftOut * hits) return;
  throw host::InputError(name + ": " + std::to_string(calibration.hits_left_out) + " of " +
                         std::to_string(calibration.hits) +
                         " hits do not fit; is the target's table of the target that was carried?");
}

void turn_up(const std::vector<Acceleration>& samples, const std::string& name, StationUnknowns& at,
             StationCalibration& out) {
  const Up up = up_of(at.motion, samples);
  if (up.direction.isZero()) throw host::InputError(name + ": the accelerations and the light have no time in common");
  const Matrix3 R = rotation_between(up.direction, Vector3::UnitZ());
  // About the first station, which keeps its place.
  const Vector3 centre = at.stations[0].T_world_station->t;
  for (network::Station& station : at.stations) {
    const auto T = *station.T_world_station;
    station.T_world_station = network::WorldFromStation{R * T.R, centre + R * (T.t - centre)};
  }
  for (network::Station& station : out.stations) {
    if (!station.sigmas) continue;
    auto& anchor = station.sigmas->anchor_m;
    const Vector3 turned = centre + R * (Vector3(anchor[0], anchor[1], anchor[2]) - centre);
    anchor = {turned.x(), turned.y(), turned.z()};
    for (Vector6& mode : station.modes) mode << R * mode.head<3>().eval(), R * mode.tail<3>().eval();
  }
  out.up_sigma_rad = up.sigma_rad;
}

}  // namespace

StationCalibration calibrate_stations(const StationCalibrationInput& input) {
  StationCalibration out;
  StationUnknowns at;
  at.stations = heard_stations(input);
  at.target = input.target;
  const Stations prior = at.stations;
  const auto sweeps = plane_sweeps(input.log, at.stations);
  start(sweeps, input, at, out.from_scratch);
  require_motion(at, input.log.name);
  const NetworkNoise noise(at.stations.size());
  StationBundleOptions options;
  options.sensor_sigma_m = input.sensor_sigma_m;
  const auto adjust = [&](const SelectionGates& gates, bool last) {
    Selection selection = select_sweeps(sweeps, at, gates);
    out.hits = selection.hits;
    out.hits_left_out = selection.hits_left;
    StationBundleResult result = adjust_stations(at, prior, input.target, selection.sweeps, noise, options, last);
    at = result.unknowns;
    if (last) fill_report(prior, input.target, selection.sweeps, options.sensor_sigma_m, result, out);
  };
  adjust(kWide, false);
  TrackedMotion again = track_motion(sweeps, at.stations, at.target, kAdjusted);
  if (again.seconds() >= kMinMotion_s) at.motion = std::move(again.pieces);
  adjust(kWide, false);
  for (const bool last : {false, true}) {
    out.pieces_left_out += drop_pieces(sweeps, at, kWide);
    adjust(kNarrow, last);
  }
  require_fit(out, input.log.name);
  if (!input.accelerations.empty()) turn_up(input.accelerations, input.log.name, at, out);
  for (std::size_t s = 0; s < at.stations.size(); ++s) {
    out.stations[s].T_world_station = at.stations[s].T_world_station;
  }
  return out;
}

}  // namespace pharos::calibrate
