// SPDX-License-Identifier: Apache-2.0
#include "tools/listen/sight_monitor.hpp"

#include <fmt/format.h>

#include "tools/listen/pose_rows.hpp"

namespace pharos::tools {
namespace {

constexpr std::int64_t kNsPerUs = 1'000;
constexpr double kSPerNs = 1e-9;
// As in pharosd, beyond three times the source's own interval: a camera's means may come every few seconds.
constexpr std::int64_t kOutOfSight_ns = 300'000'000;
constexpr std::int64_t kIntervals = 3;

}  // namespace

std::string SightMonitor::add(const ReceivedPose& pose, std::int64_t now_ns) {
  if (!pose.pose) return "";
  const auto [at, first] = streams_.try_emplace({pose.channel, pose.source, pose.target, pose.station});
  Stream& stream = at->second;
  stream.name = pose.target + ' ' + (pose.station_id.empty() ? "--------" : pose.station_id);
  const std::int64_t gap_ns = now_ns - stream.last_ns;
  stream.last_ns = now_ns;
  if (first) return "";
  if (!stream.lost) {
    stream.interval_ns = gap_ns;
    return "";
  }
  stream.lost = false;
  return fmt::format("{} {} FOUND  after {:.1f} s", clock_text(pose.utime_us), stream.name,
                     static_cast<double>(gap_ns) * kSPerNs);
}

std::vector<std::string> SightMonitor::lost(std::int64_t utc_ns, std::int64_t now_ns) {
  std::vector<std::string> rows;
  for (auto& [key, stream] : streams_) {
    const std::int64_t absence_ns = now_ns - stream.last_ns;
    if (stream.lost || stream.interval_ns == 0) continue;
    if (absence_ns < kOutOfSight_ns + kIntervals * stream.interval_ns) continue;
    stream.lost = true;
    rows.push_back(fmt::format("{} {} LOST  no pose for {:.1f} s", clock_text(utc_ns / kNsPerUs), stream.name,
                               static_cast<double>(absence_ns) * kSPerNs));
  }
  return rows;
}

}  // namespace pharos::tools
