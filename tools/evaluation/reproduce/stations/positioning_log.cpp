// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/stations/positioning_log.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <span>

#include "host/support/input_error.hpp"
#include "pharos/network/network_tracker.hpp"
#include "tools/convert/crazyflie_sweeps.hpp"
#include "tools/convert/system_config.hpp"
#include "tools/evaluation/reproduce/stations/file_content.hpp"

namespace pharos::tools {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> sorted(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> out;
  for (const auto& entry : fs::directory_iterator(folder, error)) out.push_back(entry.path());
  if (error) throw host::InputError(folder.string() + ": " + error.message());
  std::sort(out.begin(), out.end());
  return out;
}

void take_marks(const convert::CrazyflieLog& log, const std::string& name, PositioningLog& out) {
  if (log.events.size() < 2) throw host::InputError(name + ": no marks of the motion capture's start and end");
  out.marks_s = {log.events.front().time_s, log.events.back().time_s};
}

PositioningLog read_log(const fs::path& path, const fs::path& truth) {
  PositioningLog out;
  const std::string set = path.parent_path().filename().string();
  out.kind = set.substr(set.rfind('_') + 1);
  const std::string bytes = content_of(path);
  const convert::CrazyflieLog log = convert::read_crazyflie_log(
      std::span(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()), path.string());
  const fs::path config = path.parent_path() / "system-config.yaml";
  out.stations = convert::read_system_config(content_of(config), config.string());
  out.generation = static_cast<int>(out.stations[0].generation);
  out.name = "lh" + std::to_string(out.generation) + " " + out.kind + " " + path.filename().string();
  out.target = convert::lighthouse_deck();
  out.light.name = path.string();
  for (const convert::LightHit& hit : convert::sweeps_of(log, out.generation).hits) {
    out.light.hits.push_back({hit.station, hit.plane, {hit.time_s, hit.sensor, hit.theta_rad}});
  }
  for (const convert::CrossingBeam& beam : log.crossing_beams) {
    out.crossing_beams.samples.push_back({beam.time_s, beam.position_m, {}, {}, {}});
  }
  take_marks(log, path.string(), out);
  out.truth = evaluate::read_position_track(truth.string());
  return out;
}

}  // namespace

std::vector<PositioningLog> read_positioning_logs(const std::string& folder) {
  std::vector<PositioningLog> logs;
  for (const fs::path& set : sorted(folder)) {
    if (!fs::is_directory(set)) continue;
    for (const fs::path& path : sorted(set)) {
      const std::string name = path.filename().string();
      if (name.rfind("log", 0) != 0) continue;
      const fs::path truth = set / ("mocap" + name.substr(3) + ".csv.gz");
      if (fs::exists(truth)) logs.push_back(read_log(path, truth));
    }
  }
  if (logs.empty()) throw host::InputError(folder + ": no folder in it has logNN and mocapNN.csv.gz");
  return logs;
}

evaluate::PositionTrack tracked_positions(const PositioningLog& log, const network::Stations& stations) {
  const auto tracker = std::make_unique<network::NetworkTracker>(stations, log.target, network::NetworkOptions{});
  evaluate::PositionTrack out;
  const auto take = [&](const std::optional<network::NetworkResult>& result) {
    if (!result) return;
    ++out.rows;
    if (!result->pose.ok() || result->ambiguous) {
      ++out.refused;
      return;
    }
    const network::WorldFromBody& pose = result->pose.value();
    out.samples.push_back({result->time_s, pose.t, pose.R, Matrix3(result->covariance.bottomRightCorner<3, 3>()),
                           Matrix3(result->covariance.topLeftCorner<3, 3>())});
  };
  for (const calibrate::NetworkHit& one : log.light.hits) take(tracker->push(one.station, one.plane, one.hit));
  while (const auto last = tracker->flush()) take(last);
  std::stable_sort(out.samples.begin(), out.samples.end(),
                   [](const auto& a, const auto& b) { return a.time_s < b.time_s; });
  return out;
}

}  // namespace pharos::tools
