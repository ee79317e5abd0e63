// SPDX-License-Identifier: Apache-2.0
#include "tools/watch/watch_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/support/printable.hpp"
#include "pharos/base/units.hpp"
#include "tools/listen/pose_rows.hpp"
#include "tools/listen/received_state.hpp"

namespace pharos::tools {
namespace {

constexpr double kSPerNs = 1e-9;
constexpr std::size_t kMaxText = 200;
constexpr std::size_t kMaxEvents = 10;

std::string age_text(double age_s) {
  return age_s < 1.0 ? fmt::format("{:.0f} ms", age_s * 1e3) : fmt::format("{:.1f} s", age_s);
}

struct ValueText {
  std::string value = "-";
  std::string sigma = "-";
};

ValueText value_of(const SourceRow& row) {
  if (row.pose) {
    const Vector3 t_mm = row.pose->pose->t * kMmPerM;
    return {fmt::format("{:9.2f} {:9.2f} {:9.2f} mm  {}", t_mm.x(), t_mm.y(), t_mm.z(), attitude_text(*row.pose)),
            fmt::format("{:.2f} mm {:.3f} deg", row.pose->sigma_pos_m * kMmPerM, row.pose->sigma_rot_rad * kDegPerRad)};
  }
  if (row.axis) {
    return {fmt::format("axis pitch {:.4f} yaw {:.4f} deg", row.axis->pitch_rad * kDegPerRad,
                        row.axis->yaw_rad * kDegPerRad),
            fmt::format("{:.4f} deg", row.axis->sigma_rad * kDegPerRad)};
  }
  if (row.spin) {
    return {fmt::format("turns {:.4f} deg/s", row.spin->rate_rad_s.norm() * kDegPerRad),
            fmt::format("{:.4f} deg/s", row.spin->sigma_rad_s * kDegPerRad)};
  }
  return {};
}

std::string row_text(const SourceKey& key, const SourceRow& row, std::int64_t now_ns) {
  const std::string name = host::printable(row.by.empty() ? fmt::format("station {}", key.station) : row.by, 10);
  const std::string age = row.any() ? age_text(row.age_s(now_ns)) : "-";
  const bool current = row.current(now_ns);
  const ValueText text = current ? value_of(row) : ValueText{};
  return fmt::format("{:<20} {:<12} {:<10} {:<14} {:>5} {:>8} {:>6} {:>5}  {:<66} {:<22} {}",
                     host::printable(key.source, 20), host::printable(key.target, 12), name,
                     host::printable(row.any() && !current ? "LOST" : row.status, 14), row.arrivals_ns.size(), age,
                     row.refused, row.lost, text.value, text.sigma,
                     host::printable(row.fused ? fused_text(*row.fused) : row.flags, kMaxText));
}

void add_daemon(std::vector<std::string>& out, const std::string& host, const DaemonState& daemon,
                std::int64_t now_ns) {
  out.push_back(
      "pharosd on " + host::printable(host, 40) + ": " +
      (daemon.silent(now_ns)
           ? "SILENT for " + age_text(static_cast<double>(now_ns - daemon.heard_ns) * kSPerNs)
           : host::printable(daemon.state + (daemon.message.empty() ? "" : ": " + daemon.message), kMaxText)));
  for (const auto& [name, health] : daemon.sources) {
    if (!health.ptp.empty())
      out.push_back("  " + host::printable(name.first + ' ' + name.second + ": " + health.ptp, kMaxText));
    if (health.state == "ok") continue;
    const std::string error = health.state + (health.message.empty() ? "" : ": " + health.message);
    out.push_back("  " + host::printable(name.first + ' ' + name.second + ": " + error, kMaxText));
  }
}

std::string previews_text(const std::vector<CameraPreview>& previews, std::int64_t now_ns) {
  std::int64_t received = 0, lost = 0;
  std::string late;
  for (const CameraPreview& preview : previews) {
    received += preview.received;
    lost += preview.lost;
    if (preview.current(now_ns)) continue;
    late += (late.empty() ? "; none from " : ", ") +
            host::printable(preview.source + (preview.view.empty() ? "" : ' ' + preview.view), 40) + " for " +
            age_text(static_cast<double>(now_ns - preview.heard_ns) * kSPerNs);
  }
  return fmt::format("pictures: {} of {} cameras, {} lost{}", received, previews.size(), lost, late);
}

}  // namespace

std::vector<std::string> watch_lines(const SourceTable& table, std::int64_t now_ns, std::size_t columns) {
  std::vector<std::string> out;
  out.push_back(fmt::format("{:<20} {:<12} {:<10} {:<14} {:>5} {:>8} {:>6} {:>5}  {:<66} {:<22} {}", "SOURCE", "TARGET",
                            "BY", "STATUS", "1/s", "AGE", "REFUS.", "LOST", "POSITION, ATTITUDE (or AXIS)", "SIGMA",
                            "FLAGS"));
  for (const auto& [key, row] : table.rows()) out.push_back(row_text(key, row, now_ns));
  if (table.rows().empty()) out.emplace_back("(no pose yet)");
  out.emplace_back();
  for (const auto& [host, daemon] : table.daemons()) add_daemon(out, host, daemon, now_ns);
  if (table.daemons().empty()) out.emplace_back("no pharosd has told its state yet");
  if (!table.previews().empty()) out.push_back(previews_text(table.previews(), now_ns));
  const LeftOut& left_out = table.left_out();
  if (left_out.sum() > 0) {
    out.push_back(
        fmt::format("not shown: {} messages of other types, {} with impossible values, {} of more sources than fit",
                    left_out.foreign, left_out.impossible, left_out.too_many));
  }
  const auto& events = table.events();
  if (!events.empty()) out.emplace_back();
  const std::size_t shown = std::min(events.size(), kMaxEvents);
  for (auto at = events.end() - static_cast<std::ptrdiff_t>(shown); at != events.end(); ++at) {
    out.push_back(host::printable(at->text, kMaxText));
  }
  for (std::string& line : out) line.resize(std::min(line.size(), columns));
  return out;
}

}  // namespace pharos::tools
