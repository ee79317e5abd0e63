// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/stations/record_table.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <tuple>

#include "pharos/base/units.hpp"
#include "pharos/network/network_tracker.hpp"
#include "tools/convert/libsurvive_config.hpp"
#include "tools/convert/libsurvive_record.hpp"
#include "tools/evaluate/comparison.hpp"
#include "tools/evaluation/reproduce/stations/file_content.hpp"

namespace pharos::tools {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMinExternal = 500;
constexpr double kRest_m_s = 0.01, kRest_rad_s = 0.02;
constexpr double kNextTurn_s = 0.05;       // two turns
constexpr double kMadToSigma = 1.4826;     // of a normal distribution
constexpr double kTwoHits = 1.4142135624;  // a difference of two has so many times the noise of one

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// What is kept of one plane.
struct PlaneLight {
  std::vector<double> steps_rad;  // of one sensor, from turn to turn, at rest
  double square = 0.0, hits = 0.0;
};

// One device through the tracker.
class TrackedDevice {
 public:
  TrackedDevice(const network::Stations& stations, const Target& target)
      : stations_(stations),
        tracker_(std::make_unique<network::NetworkTracker>(stations, target, network::NetworkOptions{})) {}

  void push(const convert::LightHit& hit) {
    auto& [time_s, angle_rad] = last_[{hit.station, hit.plane, hit.sensor}];
    if (at_rest_ && hit.time_s - time_s < kNextTurn_s) {
      plane_[{hit.station, hit.plane}].steps_rad.push_back(std::abs(hit.theta_rad - angle_rad));
    }
    time_s = hit.time_s;
    angle_rad = hit.theta_rad;
    take(tracker_->push(hit.station, hit.plane, {hit.time_s, hit.sensor, hit.theta_rad}));
  }
  void finish() {
    while (const auto last = tracker_->flush()) take(last);
  }

  const std::map<std::pair<int, int>, PlaneLight>& planes() const { return plane_; }
  evaluate::TrajectoryFile<evaluate::EstimatePose> poses;

 private:
  void take(const std::optional<network::NetworkResult>& result) {
    if (!result) return;
    if (poses.rows++ == 0) poses.first_s = result->time_s;
    poses.last_s = result->time_s;
    at_rest_ = false;
    if (!result->pose.ok() || result->ambiguous) return;
    const Vector6& rate = tracker_->state().rate;
    at_rest_ = rate.head<3>().norm() < kRest_rad_s && rate.tail<3>().norm() < kRest_m_s;
    if (at_rest_) {
      PlaneLight& plane = plane_[{stations_[result->station].number, result->plane}];
      plane.square += result->observations * result->residual_rms_rad * result->residual_rms_rad;
      plane.hits += result->observations;
    }
    if (!poses.samples.empty() && result->time_s <= poses.samples.back().time_s) return;
    const network::WorldFromBody& pose = result->pose.value();
    poses.samples.push_back({result->time_s,
                             {pose.R, pose.t},
                             std::sqrt(result->covariance.topLeftCorner<3, 3>().trace()),
                             std::sqrt(result->covariance.bottomRightCorner<3, 3>().trace())});
  }

  const network::Stations& stations_;
  std::unique_ptr<network::NetworkTracker> tracker_;
  std::map<std::tuple<int, int, int>, std::pair<double, double>> last_;
  std::map<std::pair<int, int>, PlaneLight> plane_;
  bool at_rest_ = false;
};

evaluate::TrajectoryFile<evaluate::TruthPose> external_poses(const convert::LibsurviveRecord& record,
                                                             const std::string& device) {
  evaluate::TrajectoryFile<evaluate::TruthPose> out;
  for (const convert::ExternalPose& pose : record.external) {
    if (pose.device != "replay_" + device) continue;
    if (!out.samples.empty() && pose.time_s <= out.samples.back().time_s) continue;
    ++out.rows;
    out.samples.push_back({pose.time_s, {pose.q.normalized().toRotationMatrix(), pose.t}, std::nullopt, std::nullopt});
  }
  if (!out.samples.empty()) {
    out.first_s = out.samples.front().time_s;
    out.last_s = out.samples.back().time_s;
  }
  return out;
}

void add_device(const std::string& item, const network::Stations& stations, const convert::RecordedDevice& device,
                const evaluate::TrajectoryFile<evaluate::TruthPose>& external, std::vector<ComparisonRow>& rows) {
  TrackedDevice tracked(stations, device.target);
  for (const convert::LightHit& hit : device.hits) tracked.push(hit);
  tracked.finish();
  rows.push_back({item, "sweeps answered", "%", "",
                  100.0 * static_cast<double>(tracked.poses.samples.size()) /
                      static_cast<double>(std::max<std::size_t>(1, tracked.poses.rows)),
                  std::to_string(tracked.poses.samples.size()) + " of " + std::to_string(tracked.poses.rows)});
  for (const auto& [key, plane] : tracked.planes()) {
    const std::string name = "station " + std::to_string(key.first) + " plane " + (key.second == 0 ? "a" : "b");
    if (plane.steps_rad.size() >= 100) {
      rows.push_back({item, name + ": noise of a hit at rest", "arcsec", "4 to 5",
                      kMadToSigma * median_of(plane.steps_rad) / kTwoHits * kArcsecPerRad, "from turn to turn"});
    }
    if (plane.hits >= 100.0) {
      rows.push_back({item, name + ": residual of a hit at rest, RMS", "arcsec", "",
                      std::sqrt(plane.square / plane.hits) * kArcsecPerRad,
                      std::to_string(static_cast<long>(plane.hits)) + " hits"});
    }
  }
  evaluate::ComparisonOptions options;
  options.mode = evaluate::AlignMode::kHandEye;
  evaluate::Comparison there = evaluate::compare(tracked.poses, external, options);
  // A device at rest tells no frames: how far the two wander apart is left.
  if (!there.refused.empty()) {
    options.mode = evaluate::AlignMode::kNone;
    there = evaluate::compare(tracked.poses, external, options);
  }
  if (!there.refused.empty()) {
    rows.push_back({item, "agreement with EXTERNAL_POSE", "", "", std::nullopt, there.why});
    return;
  }
  const bool aligned = options.mode == evaluate::AlignMode::kHandEye;
  const std::string remark = aligned ? "frames and bodies aligned" : "about the mean, at rest";
  const auto& [rotation, position] = std::pair(there.figures.rotation, there.figures.position);
  rows.push_back({item, "agreement with EXTERNAL_POSE: position, RMS", "mm", "",
                  (aligned ? position.error.rms : position.spread) * kMmPerM, remark});
  rows.push_back({item, "agreement with EXTERNAL_POSE: rotation, RMS", "deg", "",
                  (aligned ? rotation.error.rms : rotation.spread) * kDegPerRad, remark});
}

}  // namespace

std::vector<ComparisonRow> reproduce_records(const std::string& folder) {
  std::vector<ComparisonRow> rows;
  std::error_code error;
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(folder, error)) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  for (const fs::path& path : paths) {
    const fs::path config = path.string() + ".json";
    if (!path.string().ends_with(".rec.gz") || !fs::exists(config)) continue;
    network::Stations stations = convert::read_libsurvive_config(content_of(config), config.string());
    const convert::LibsurviveRecord record = convert::read_libsurvive_record(host::ByteSource(path.string()));
    convert::place_stations(record, stations);
    const std::string name = path.filename().string();
    for (const auto& [device_name, device] : record.devices) {
      const auto external = external_poses(record, device_name);
      if (external.samples.size() < kMinExternal) continue;
      add_device(name.substr(0, name.find('.')) + " " + device_name, stations, device, external, rows);
    }
  }
  return rows;
}

}  // namespace pharos::tools
