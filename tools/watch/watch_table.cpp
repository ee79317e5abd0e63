// SPDX-License-Identifier: Apache-2.0
#include "tools/watch/watch_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "pharos/base/units.hpp"
#include "pharos/pointing_t.hpp"
#include "pharos/status_t.hpp"
#include "tools/listen/pose_rows.hpp"

namespace pharos::tools {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr double kSPerNs = 1e-9;
// 32 targets with two stations each and five cameras are 69 rows; whoever sends more names than this is not a daemon.
constexpr std::size_t kMaxRows = 128;
constexpr std::size_t kMaxDaemons = 16;
constexpr std::size_t kMaxEvents = 10;
// More arrivals a second than any source has: the rate shown is this at most.
constexpr std::size_t kMaxArrivals = 4096;
// pharosd tells its state once a second.
constexpr std::int64_t kDaemonSilent_ns = 3 * kSecond_ns;
constexpr std::size_t kMaxText = 200;

std::string age_text(double age_s) {
  return age_s < 1.0 ? fmt::format("{:.0f} ms", age_s * 1e3) : fmt::format("{:.1f} s", age_s);
}

}  // namespace

std::string printable(std::string_view text, std::size_t size) {
  std::string out(text.substr(0, size));
  std::replace_if(
      out.begin(), out.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return out;
}

WatchTable::Row* WatchTable::row_of(const Key& key) {
  const auto at = rows_.find(key);
  if (at != rows_.end()) return &at->second;
  if (rows_.size() < kMaxRows) return &rows_[key];
  ++rows_left_out_;
  return nullptr;
}

void WatchTable::arrived(Row& row, std::int64_t sequence, bool valid, double age_s, std::int64_t now_ns) {
  if (row.sequence >= 0 && sequence > row.sequence) row.lost += sequence - row.sequence - 1;
  row.sequence = sequence;
  if (!valid) {
    ++row.refused;
    return;
  }
  ++received_;
  row.last_ns = now_ns;
  row.age_at_arrival_s = age_s;
  row.arrivals_ns.push_back(now_ns);
  if (row.arrivals_ns.size() > kMaxArrivals) row.arrivals_ns.pop_front();
}

void WatchTable::add(const ReceivedPose& pose, std::int64_t now_ns) {
  Row* row = row_of({pose.channel, pose.source, pose.target, pose.station});
  if (row == nullptr) return;
  arrived(*row, pose.sequence, pose.pose.has_value(), pose.age_s, now_ns);
  row->station = pose.station_id;
  row->status = pose.status;
  row->flags = pose.flags;
  if (pose.pose) {
    const Vector3 t_mm = pose.pose->t * kMmPerM;
    row->value = fmt::format("{:9.2f} {:9.2f} {:9.2f} mm  {}", t_mm.x(), t_mm.y(), t_mm.z(), attitude_text(pose));
    row->sigma = fmt::format("{:.2f} mm {:.3f} deg", pose.sigma_pos_m * kMmPerM, pose.sigma_rot_rad * kDegPerRad);
  }
  const std::string found = sight_.add(pose, now_ns);
  if (!found.empty()) event(found);
}

void WatchTable::add(const std::string& channel, const pointing_t& pointing, std::int64_t utc_ns, std::int64_t now_ns) {
  Row* row = row_of({channel, pointing.source, pointing.target, 0});
  if (row == nullptr) return;
  const double age_s = static_cast<double>(utc_ns) * kSPerNs - static_cast<double>(pointing.utime) * 1e-6;
  arrived(*row, pointing.sequence, pointing.valid != 0, age_s, now_ns);
  row->station = pointing.station_or_camera;
  row->status = pointing.status;
  row->flags = pointing.flags;
  if (pointing.valid == 0) return;
  row->value =
      fmt::format("axis pitch {:.4f} yaw {:.4f} deg", pointing.pitch_rad * kDegPerRad, pointing.yaw_rad * kDegPerRad);
  row->sigma = fmt::format("{:.4f} deg", pointing.sigma_axis_rad * kDegPerRad);
}

void WatchTable::add(const status_t& status, std::int64_t now_ns) {
  if (!daemons_.contains(status.host) && daemons_.size() >= kMaxDaemons) {
    ++rows_left_out_;
    return;
  }
  ++received_;
  Daemon& daemon = daemons_[status.host];
  if (!daemon.state.empty() && daemon.state != status.state) {
    event(fmt::format("{} {} is {}{}", clock_text(status.utime), status.host, status.state,
                      status.message.empty() ? "" : ": " + status.message));
  }
  daemon = {status.state, status.message, now_ns, {}};
  for (const source_status_t& source : status.sources) {
    if (source.state == "ok" || daemon.errors.size() >= kMaxRows) continue;
    daemon.errors[{source.source, source.target}] =
        source.state + (source.message.empty() ? "" : ": " + source.message);
  }
}

void WatchTable::tick(std::int64_t utc_ns, std::int64_t now_ns) {
  for (const std::string& line : sight_.lost(utc_ns, now_ns)) event(line);
  for (auto& [key, row] : rows_) {
    while (!row.arrivals_ns.empty() && row.arrivals_ns.front() <= now_ns - kSecond_ns) row.arrivals_ns.pop_front();
  }
}

void WatchTable::event(std::string line) {
  events_.push_back(std::move(line));
  if (events_.size() > kMaxEvents) events_.pop_front();
}

std::string WatchTable::row_text(const Key& key, const Row& row, std::int64_t now_ns) const {
  const auto& [channel, source, target, station] = key;
  const std::string name = printable(row.station.empty() ? fmt::format("station {}", station) : row.station, 10);
  const bool any = row.last_ns != 0;
  const std::string age =
      any ? age_text(row.age_at_arrival_s + static_cast<double>(now_ns - row.last_ns) * kSPerNs) : "-";
  // A pose that is no longer current must not look as if it were.
  const bool current = any && now_ns - row.last_ns < kSecond_ns + kSecond_ns / 2;
  return fmt::format("{:<20} {:<12} {:<10} {:<14} {:>5} {:>8} {:>6} {:>5}  {:<66} {:<22} {}", printable(source, 20),
                     printable(target, 12), name, printable(any && !current ? "LOST" : row.status, 14),
                     row.arrivals_ns.size(), age, row.refused, row.lost, current ? row.value : std::string("-"),
                     current ? row.sigma : std::string("-"), printable(row.flags, kMaxText));
}

std::vector<std::string> WatchTable::lines(std::int64_t now_ns, std::size_t columns) const {
  std::vector<std::string> out;
  out.push_back(fmt::format("{:<20} {:<12} {:<10} {:<14} {:>5} {:>8} {:>6} {:>5}  {:<66} {:<22} {}", "SOURCE", "TARGET",
                            "BY", "STATUS", "1/s", "AGE", "REFUS.", "LOST", "POSITION, ATTITUDE (or AXIS)", "SIGMA",
                            "FLAGS"));
  for (const auto& [key, row] : rows_) out.push_back(row_text(key, row, now_ns));
  if (rows_.empty()) out.emplace_back("(no pose yet)");
  out.emplace_back();
  for (const auto& [host, daemon] : daemons_) {
    const bool silent = now_ns - daemon.last_ns > kDaemonSilent_ns;
    out.push_back("pharosd on " + printable(host, 40) + ": " +
                  (silent ? "SILENT for " + age_text(static_cast<double>(now_ns - daemon.last_ns) * kSPerNs)
                          : printable(daemon.state + (daemon.message.empty() ? "" : ": " + daemon.message), kMaxText)));
    for (const auto& [name, error] : daemon.errors) {
      out.push_back("  " + printable(name.first + ' ' + name.second + ": " + error, kMaxText));
    }
  }
  if (daemons_.empty()) out.emplace_back("no pharosd has told its state yet");
  if (unknown_ + rows_left_out_ > 0) {
    out.push_back(
        fmt::format("not shown: {} messages of other types, {} of more sources than fit", unknown_, rows_left_out_));
  }
  if (!events_.empty()) out.emplace_back();
  for (const std::string& line : events_) out.push_back(printable(line, kMaxText));
  for (std::string& line : out) line.resize(std::min(line.size(), columns));
  return out;
}

}  // namespace pharos::tools
