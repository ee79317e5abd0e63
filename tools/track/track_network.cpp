// SPDX-License-Identifier: Apache-2.0
// pharos track --sweeps: one to sixteen stations of a room to poses in the world.
#include "tools/track/track_network.hpp"

#include <memory>

#include "host/stations/network_file.hpp"
#include "host/stations/sweep_table.hpp"
#include "host/stations/world_estimator.hpp"
#include "host/support/input_error.hpp"
#include "host/table/target_file.hpp"
#include "pharos/base/units.hpp"
#include "pharos/network/network_tracker.hpp"
#include "tools/support/commands.hpp"
#include "tools/support/pose_columns.hpp"
#include "tools/support/recording.hpp"
#include "tools/support/standard_input.hpp"
#include "tools/support/target_notes.hpp"

namespace pharos::tools {
namespace {

std::vector<std::string> network_columns() {
  std::vector<std::string> last = {"sigma_rot_deg", "sigma_pos_mm", "rms_arcsec", "observations", "status", "flags"};
  for (const std::string& column : second_solution_columns()) last.push_back(column);
  for (const char* column : {"cov_xx_m2", "cov_xy_m2", "cov_xz_m2", "cov_yy_m2", "cov_yz_m2", "cov_zz_m2"}) {
    last.emplace_back(column);
  }
  return with_pose_columns({"time_s", "station"}, last);
}

std::string network_flag_words(std::uint8_t flags) {
  std::string words;
  const auto add = [&](std::uint8_t flag, const char* word) {
    if ((flags & flag) != 0) words += (words.empty() ? "" : "|") + std::string(word);
  };
  add(network::kFused, "fused");
  add(network::kOutliers, "outliers");
  add(network::kStationExcluded, "station_excluded");
  return words;
}

void write_any_pose(host::RowWriter& rows, const network::WorldFromBody& pose) {
  const Quaternion q = pose.quaternion();
  for (const double v : {q.w(), q.x(), q.y(), q.z(), pose.t.x(), pose.t.y(), pose.t.z()}) rows.number(v);
}

void write_result(const network::NetworkResult& result, const network::Stations& stations, host::RowWriter& rows) {
  rows.number(result.time_s).integer(stations[result.station].number);
  const bool ok = result.pose.ok();
  if (ok) {
    write_any_pose(rows, result.pose.value());
    rows.number(std::sqrt(result.covariance.topLeftCorner<3, 3>().trace()) * kDegPerRad);
    rows.number(std::sqrt(result.covariance.bottomRightCorner<3, 3>().trace()) * kMmPerM);
    rows.number(result.residual_rms_rad * kArcsecPerRad);
    rows.pose({result.time_s, result.pose.value().quaternion(), result.pose.value().t, result.covariance,
               result.ambiguous ? host::PoseGrade::kAmbiguous : host::PoseGrade::kGood});
  } else {
    write_no_pose(rows);
    rows.none(3);
  }
  const bool ambiguous = ok && result.ambiguous;
  rows.integer(result.observations);
  rows.text(!ok ? "refused_" + std::string(pose::name_of(result.pose.error())) : ambiguous ? "ambiguous" : "ok");
  rows.text(network_flag_words(result.flags));
  if (ambiguous) {
    write_any_pose(rows, result.second);
    rows.number(result.delta_chi2);
  } else {
    rows.none(second_solution_columns().size());
  }
  if (ok) {
    const Matrix3 C = result.covariance.bottomRightCorner<3, 3>();
    for (const double v : {C(0, 0), C(0, 1), C(0, 2), C(1, 1), C(1, 2), C(2, 2)}) rows.number(v);
  } else {
    rows.none(6);
  }
  rows.end_row();
}

void require_poses(const network::Stations& stations, const std::string& path) {
  for (const network::Station& station : stations) {
    if (!station.T_world_station) {
      throw host::InputError(path + ": station " + std::to_string(station.number) +
                             " has no position_m and rotation_wxyz; leave it out or give them");
    }
  }
}

// Results as rows.
class NetworkTracking {
 public:
  NetworkTracking(const network::Stations& stations, const OutputOptions& options)
      : stations_(stations), output_(options, network_columns()) {}

  void take(const std::optional<network::NetworkResult>& result) {
    if (!result) return;
    write_result(*result, stations_, output_.rows());
    if (result->pose.ok()) ++poses_;
  }
  void show() { output_.rows().flush(); }
  void finish() { output_.finish(); }
  std::size_t poses() const { return poses_; }

 private:
  const network::Stations& stations_;
  Output output_;
  std::size_t poses_ = 0;
};

network::NetworkCounters track_table(const std::string& path, const network::Stations& stations, const Target& target,
                                     NetworkTracking& out) {
  const auto tracker = std::make_unique<network::NetworkTracker>(stations, target, network::NetworkOptions{});
  host::SweepTable sweeps(path);
  while (sweeps.next()) {
    const network::Station* station = network::find_station(stations, sweeps.station());
    if (station != nullptr) sweeps.require(station->generation);
    out.take(tracker->push(sweeps.station(), sweeps.plane(), sweeps.hit()));
  }
  while (const auto last = tracker->flush()) out.take(last);
  return tracker->counters();
}

network::NetworkCounters track_stream(const std::string& path, const network::Stations& stations, const Target& target,
                                      NetworkTracking& out) {
  Recording recording(path);
  recording.on_pause([&out] { out.show(); });
  host::WorldEstimator estimator(stations, target);
  const auto take = [&] {
    while (const auto result = estimator.next()) out.take(result);
  };
  while (const std::optional<RecordingEvent> event = recording.next()) {
    if (!is_lh2(*event)) {
      throw host::InputError(recording.name() + ": light of Lighthouse 1.0; leave out --stations, or give --sweeps");
    }
    const auto* sweep = std::get_if<lighthouse::Lh2Sweep>(&*event);
    if (sweep == nullptr) continue;
    estimator.push(*sweep);
    take();
  }
  estimator.flush();
  take();
  recording.print_remarks();
  return estimator.counters();
}

void print_counters(const network::NetworkCounters& c) {
  note("hits " + std::to_string(c.hits) + ", of unknown stations " + std::to_string(c.hits_unknown) + ", left out " +
       std::to_string(c.hits_left_out) + "; sweeps " + std::to_string(c.sweeps) + ", refused " +
       std::to_string(c.sweeps_refused) + "; starts " + std::to_string(c.starts) + ", losses " +
       std::to_string(c.losses) + ", strays " + std::to_string(c.strays) + ", stations excluded " +
       std::to_string(c.exclusions) + ", readmitted " + std::to_string(c.readmissions));
}

}  // namespace

int track_network(const NetworkFiles& files, const OutputOptions& output_options) {
  const bool table = !files.sweeps.empty();
  const std::string& light = table ? files.sweeps : files.stream;
  require_one_standard_input(
      {{table ? "--sweeps" : "EDGES", light}, {"--stations", files.stations}, {"--target", files.target}});
  const network::Stations stations = host::read_network_file(files.stations);
  require_poses(stations, files.stations);
  const host::TargetFile target = host::read_target(files.target);
  note_target_shape(files.target, target.shape);
  NetworkTracking out(stations, output_options);
  const network::NetworkCounters c =
      table ? track_table(light, stations, target.target, out) : track_stream(light, stations, target.target, out);
  out.finish();
  if (files.stats) print_counters(c);
  if (c.exclusions > 0) note(files.stations + ": a station contradicts the others and was left out: was it moved?");
  if (out.poses() == 0) note(light + ": no pose; see the column status");
  return out.poses() > 0 ? kExitAnswered : kExitNoAnswer;
}

}  // namespace pharos::tools
