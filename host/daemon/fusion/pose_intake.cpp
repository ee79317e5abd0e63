// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/fusion/pose_intake.hpp"

#include <algorithm>
#include <array>

#include "host/publish/words.hpp"
#include "pharos/pose_t.hpp"

namespace pharos::host {
namespace {

constexpr const char* kNoConnector = "no_connector";

bool has_word(const std::string& flags, const std::string& word) {
  return ('|' + flags + '|').find('|' + word + '|') != std::string::npos;
}

SensorFromFeature pose_of(const double (&wxyz)[4], const double (&position_m)[3]) {
  const Quaternion q(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
  return {q.normalized().toRotationMatrix(), Vector3(position_m)};
}

// Poses of a room's stations are in the world, those of one station in its own frame.
bool frames_fit(SourceKind kind, const pose_t& message) {
  const std::string& parent = message.parent_frame;
  if (kind == SourceKind::kLighthouse) {
    return (parent == "lighthouse" || parent == "world") && message.child_frame == "body";
  }
  return parent == (kind == SourceKind::kRing2 ? "rig" : "camera") && message.child_frame == "target";
}

SourceRow row_of(SourceKind kind, const pose_t& message) {
  SourceRow row;
  row.time_s = static_cast<double>(message.utime) * 1e-6;
  row.time_sigma_s = static_cast<float>(message.utime_sigma_us) * 1e-6F;
  row.pose = pose_of(message.orientation_wxyz, message.position_m);
  row.has_turn = kind != SourceKind::kRing2 && !has_word(message.flags, kNoConnector);
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) row.covariance(i, j) = message.covariance[6 * i + j];
  }
  if (message.has_second != 0) {
    row.second = pose_of(message.second_orientation_wxyz, message.second_position_m);
    row.delta_chi2 = message.second_delta_chi2;
  }
  return row;
}

}  // namespace

bool is_doubtful(const pose_t& message) {
  constexpr std::array kDoubtful = {"uncalibrated", kSuspectWord, kClockSetWord};
  return std::any_of(kDoubtful.begin(), kDoubtful.end(),
                     [&](const char* word) { return has_word(message.flags, word); });
}

PoseIntake::PoseIntake(const VehicleConfig& config)
    : target_(config.target), sources_(config.sources), stations_(config.sources.size()) {}

// Of several stations of one target the one with this id.
std::optional<std::size_t> PoseIntake::source_of(const pose_t& message) const {
  if (message.target != target_) return std::nullopt;
  std::optional<std::size_t> found;
  for (std::size_t s = 0; s < sources_.size(); ++s) {
    const FusedSourceConfig& source = sources_[s];
    const bool named_after_daemon = source.mounting.kind == SourceKind::kLighthouse && !source.is_remote;
    const bool of_it =
        named_after_daemon ? message.source.rfind(source.source + '/', 0) == 0 : message.source == source.source;
    if (!of_it) continue;
    if (!found || source.station == message.station_or_camera) found = s;
  }
  return found;
}

bool PoseIntake::is_its_station(std::size_t source, const pose_t& message) {
  const FusedSourceConfig& config = sources_[source];
  if (config.mounting.kind != SourceKind::kLighthouse) return true;
  if (!config.station.empty()) return message.station_or_camera == config.station;
  SeenStation& seen = stations_[source];
  const std::string& id = message.station_or_camera;
  if (!seen.any) seen = {true, false, message.station, id};
  if (seen.id.empty()) seen.id = id;
  const bool other = message.station != seen.slot || (!id.empty() && id != seen.id);
  if (other && !seen.several) {
    seen.several = true;
    error_ = config.mounting.name + ": several stations are in sight (" + seen.id + ", " + id +
             ") and the mounting is of one: give [[vehicle.station]] source and id";
  }
  return !seen.several;
}

std::optional<TakenPose> PoseIntake::take(const std::string& channel, const pose_t& message) {
  const std::optional<std::size_t> source = source_of(message);
  if (!source || channel == "LIGHTHOUSE_BOARD_POSE") {
    ++counters_.poses_not_fused;
    return std::nullopt;
  }
  if (message.valid == 0) {
    ++counters_.poses_without_answer;
    return std::nullopt;
  }
  const SourceKind kind = sources_[*source].mounting.kind;
  if (!frames_fit(kind, message)) {
    ++counters_.poses_other_frame;
    return std::nullopt;
  }
  if (is_doubtful(message)) {
    ++counters_.poses_doubtful;
    return std::nullopt;
  }
  if (!is_its_station(*source, message)) {
    ++counters_.poses_other_station;
    return std::nullopt;
  }
  ++counters_.poses_taken;
  return TakenPose{*source, row_of(kind, message)};
}

NamedCounts named_counts(const IntakeCounters& counters) {
  NamedCounts counts;
#define PHAROS_X(name, text) counts.push_back({#name, counters.name});
  PHAROS_INTAKE_COUNTERS(PHAROS_X)
#undef PHAROS_X
  return counts;
}

}  // namespace pharos::host
