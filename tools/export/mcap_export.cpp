// SPDX-License-Identifier: Apache-2.0
#include "tools/export/mcap_export.hpp"

#include <cmath>
#include <limits>

#include "pharos/bearings_t.hpp"
#include "pharos/clock_exchange_t.hpp"
#include "pharos/pointing_t.hpp"
#include "pharos/pose_t.hpp"
#include "pharos/preview_t.hpp"
#include "pharos/spin_t.hpp"
#include "pharos/status_t.hpp"
#include "pharos/target_state_t.hpp"
#include "tools/listen/received_state.hpp"
#include "tools/listen/subscription.hpp"

namespace pharos::tools {
namespace {

constexpr std::int64_t kNsPerUs = 1000;
constexpr std::int64_t kUsPerS = 1'000'000;

// Not before 1970, and not beyond what 64 bits of ns hold.
bool is_time(std::int64_t utime_us) {
  return utime_us >= 0 && utime_us <= std::numeric_limits<std::int64_t>::max() / kNsPerUs;
}
std::uint64_t nanoseconds(std::int64_t utime_us) { return static_cast<std::uint64_t>(utime_us * kNsPerUs); }

Json time_json(std::int64_t utime_us) { return {{"sec", utime_us / kUsPerS}, {"nsec", utime_us % kUsPerS * kNsPerUs}}; }
Json vector_json(const Vector3& v) { return {{"x", v.x()}, {"y", v.y()}, {"z", v.z()}}; }
Json quaternion_json(const Quaternion& q) { return {{"x", q.x()}, {"y", q.y()}, {"z", q.z()}, {"w", q.w()}}; }

// Topics are UTF-8; LCM's channels are any bytes.
std::string topic_of(const std::string& channel) {
  std::string topic = "/";
  for (const char c : channel) topic += c > ' ' && c <= '~' ? c : '?';
  return topic;
}

bool is_rotation(const double (&wxyz)[4]) {
  constexpr double kMaxNormError = 0.01;
  return std::abs(std::hypot(std::hypot(wxyz[0], wxyz[1]), std::hypot(wxyz[2], wxyz[3])) - 1.0) < kMaxNormError;
}

// A frame has one parent in a tree of transforms, and sources and stations have frames of their own.
std::string frame_prefix(const pose_t& pose) {
  const bool of_station = pose.parent_frame == "lighthouse";
  return pose.source + '/' + (of_station ? "station" + std::to_string(int{pose.station}) + '/' : std::string());
}

}  // namespace

ChannelCounts& McapExport::counts_of(std::string_view channel) {
  std::string name(channel);
  if (channels_.size() >= kMaxChannels && channels_.find(name) == channels_.end()) name = "...";
  return channels_[name];
}

void McapExport::push(const LoggedMessage& message) {
  const std::string channel(message.channel);
  ChannelCounts& counts = counts_of(channel);
  if (!is_time(message.utime_us)) {
    ++counts.without_time;
    return;
  }
  if (take<pose_t>(Topic::kPose, channel, message) || take<status_t>(Topic::kStatus, channel, message) ||
      take<bearings_t>(Topic::kBearings, channel, message) || take<pointing_t>(Topic::kPointing, channel, message) ||
      take<spin_t>(Topic::kSpin, channel, message) || take<target_state_t>(Topic::kTargetState, channel, message) ||
      take<preview_t>(Topic::kPreview, channel, message) || take_clock(channel, message)) {
    return;
  }
  ++counts.foreign;
}

template <class Message>
bool McapExport::take(Topic topic, const std::string& channel, const LoggedMessage& logged) {
  Message message;
  if (!decode(message, logged.data.data(), static_cast<int>(logged.data.size()))) return false;
  const Json json = json_of(message);
  ChannelCounts& counts = counts_of(channel);
  if (!all_finite(json)) {
    ++counts.not_finite;
    return true;
  }
  const std::uint64_t log_ns = nanoseconds(logged.utime_us);
  const Stamp stamp{log_ns, is_time(message.utime) ? nanoseconds(message.utime) : log_ns,
                    static_cast<std::uint32_t>(message.sequence)};
  write(topic, channel, "", stamp, json);
  write_more(message, channel, stamp);
  ++counts.exported;
  return true;
}

// Not a measurement: its time is that of the log.
bool McapExport::take_clock(const std::string& channel, const LoggedMessage& logged) {
  clock_exchange_t message{};
  if (!decode(message, logged.data.data(), static_cast<int>(logged.data.size()))) return false;
  const std::uint64_t log_ns = nanoseconds(logged.utime_us);
  write(Topic::kClock, channel, "", {log_ns, log_ns, static_cast<std::uint32_t>(message.sequence)}, json_of(message));
  ++counts_of(channel).exported;
  return true;
}

void McapExport::write(Topic topic, const std::string& channel, const std::string& suffix, const Stamp& stamp,
                       const Json& json) {
  // A channel may hold several types: each has a topic of its own, with the type behind the first one's name.
  std::uint16_t& schema = schemas_[static_cast<std::size_t>(topic)];
  if (schema == 0) schema = writer_.add_schema(schema_name(topic), text_of(schema_of(topic)));
  const std::string key = channel + suffix + '\n' + schema_name(topic);
  auto place = topics_.find(key);
  if (place == topics_.end()) {
    place = topics_.emplace(key, writer_.add_channel(schema, topic_of(channel) + suffix)).first;
  }
  writer_.add_message(place->second, stamp.sequence, stamp.log_ns, stamp.publish_ns, text_of(json));
}

void McapExport::write_more(const pose_t& pose, const std::string& channel, const Stamp& stamp) {
  if (!is_rotation(pose.orientation_wxyz)) return;
  const ReceivedPose received = received_pose(channel, pose, 0);
  if (!received.pose || grade_of(received) != host::PoseGrade::kGood || !is_time(pose.utime)) return;
  const std::string prefix = frame_prefix(pose);
  write_pose(channel, stamp, pose.utime, prefix + pose.parent_frame, prefix + pose.target + '/' + pose.child_frame,
             *received.pose);
}

void McapExport::write_more(const target_state_t& state, const std::string& channel, const Stamp& stamp) {
  if (state.valid == 0 || state.has_conflict != 0) return;
  if (!is_rotation(state.orientation_wxyz) || !is_time(state.utime)) return;
  const std::string prefix = std::string(kFusionSource) + '/';
  write_pose(channel, stamp, state.utime, prefix + "vehicle", prefix + state.target + "/target",
             *received_state(channel, state, 0).pose);
}

void McapExport::write_pose(const std::string& channel, const Stamp& stamp, std::int64_t utime_us,
                            const std::string& parent, const std::string& child, const LighthouseFromBody& pose) {
  const Json time = time_json(utime_us), t = vector_json(pose.t), q = quaternion_json(pose.quaternion());
  write(Topic::kTransform, channel, "/transform", stamp,
        {{"timestamp", time},
         {"parent_frame_id", parent},
         {"child_frame_id", child},
         {"translation", t},
         {"rotation", q}});
  write(Topic::kPoseInFrame, channel, "/pose", stamp,
        {{"timestamp", time}, {"frame_id", parent}, {"pose", {{"position", t}, {"orientation", q}}}});
}

void McapExport::write_more(const status_t& status, const std::string& channel, const Stamp& stamp) {
  write(Topic::kCounters, channel, "/counters", stamp, counters_of(status));
}

void McapExport::write_more(const preview_t& preview, const std::string& channel, const Stamp& stamp) {
  if (!is_time(preview.utime)) return;
  const std::string camera = preview.source + (preview.view.empty() ? "" : '/' + preview.view);
  if (cameras_.size() < kMaxCameras) cameras_.insert(camera);
  const std::string suffix = cameras_.contains(camera) ? topic_of(camera) + "/image" : "/image";
  write(Topic::kImage, channel, suffix, stamp,
        {{"timestamp", time_json(preview.utime)},
         {"frame_id", preview.source + (preview.view.empty() ? "/camera" : '/' + preview.view)},
         {"data", base64(preview.data)},
         {"format", preview.format}});
}

std::int64_t McapExport::exported() const {
  std::int64_t sum = 0;
  for (const auto& [name, counts] : channels_) sum += counts.exported;
  return sum;
}

}  // namespace pharos::tools
