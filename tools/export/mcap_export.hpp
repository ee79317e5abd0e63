// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "tools/export/mcap_writer.hpp"
#include "tools/export/schemas.hpp"
#include "tools/lcm_log/lcm_log.hpp"
#include "tools/listen/received_pose.hpp"

namespace pharos {
class pose_t;
class preview_t;
class status_t;
class target_state_t;
}  // namespace pharos

namespace pharos::tools {

/// What became of a channel's messages.
struct ChannelCounts {
  std::int64_t exported = 0;
  std::int64_t foreign = 0;       // of no type of Pharos, or not whole
  std::int64_t not_finite = 0;    // with a number that JSON does not have
  std::int64_t without_time = 0;  // logged before 1970
};

/// Messages of a log into an MCAP file. Every message becomes JSON with all its fields on the topic /CHANNEL; a good
/// pose or state also a transform and a pose of Foxglove's schemas (/CHANNEL/transform, /CHANNEL/pose), a status its
/// counters by name (/CHANNEL/counters), a preview its picture (/CHANNEL/SOURCE[/VIEW]/image).
class McapExport {
 public:
  /// Counts of further channels are summed up under "...": a log's channel names come from anyone.
  static constexpr std::size_t kMaxChannels = 1000;
  /// Pictures of further cameras are on one topic, /CHANNEL/image.
  static constexpr std::size_t kMaxCameras = 64;

  McapExport(std::FILE* stream, std::string_view library) : writer_(stream, library) {}

  void push(const LoggedMessage& message);
  void finish() { writer_.finish(); }

  const std::map<std::string, ChannelCounts>& channels() const { return channels_; }
  std::uint64_t written() const { return writer_.messages(); }
  std::int64_t exported() const;

 private:
  struct Stamp {
    std::uint64_t log_ns = 0, publish_ns = 0;
    std::uint32_t sequence = 0;
  };
  ChannelCounts& counts_of(std::string_view channel);
  template <class Message>
  bool take(Topic topic, const std::string& channel, const LoggedMessage& message);
  bool take_clock(const std::string& channel, const LoggedMessage& message);
  void write(Topic topic, const std::string& channel, const std::string& suffix, const Stamp& stamp, const Json& json);
  void write_pose(const std::string& channel, const Stamp& stamp, std::int64_t utime_us, const std::string& parent,
                  const std::string& child, const LighthouseFromBody& pose);
  void write_more(const pose_t& pose, const std::string& channel, const Stamp& stamp);
  void write_more(const status_t& status, const std::string& channel, const Stamp& stamp);
  void write_more(const target_state_t& state, const std::string& channel, const Stamp& stamp);
  void write_more(const preview_t& preview, const std::string& channel, const Stamp& stamp);
  template <class Other>
  void write_more(const Other&, const std::string&, const Stamp&) {}

  McapWriter writer_;
  std::array<std::uint16_t, kTopics> schemas_{};  // 0: not written yet
  std::map<std::string, std::uint16_t> topics_;
  std::map<std::string, ChannelCounts> channels_;
  std::set<std::string> cameras_;
};

}  // namespace pharos::tools
