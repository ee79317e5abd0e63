// SPDX-License-Identifier: Apache-2.0
#include "tools/view/lights.hpp"

#include <fmt/format.h>

#include <string_view>

#include "pharos/base/units.hpp"

namespace pharos::tools {
namespace {

constexpr double kSPerNs = 1e-9;
// As long as a value stays current.
constexpr std::int64_t kSilent_ns = 1'500'000'000;

bool has_flag(const SourceRow& row, std::string_view flag) {
  std::string_view flags = row.flags;
  while (!flags.empty()) {
    const std::size_t end = flags.find('|');
    if (flags.substr(0, end) == flag) return true;
    if (end == std::string_view::npos) return false;
    flags.remove_prefix(end + 1);
  }
  return false;
}

// "refused_poor_fit" -> "refused: poor fit".
std::string refusal_words(std::string status) {
  if (status.starts_with("refused_")) status.replace(0, 8, "refused: ");
  for (char& c : status) c = c == '_' ? ' ' : c;
  return status;
}

bool is_refused(const SourceRow& row) { return row.status.starts_with("refused"); }

std::string daemon_words(const SourceHealth& health) {
  return health.message.empty() ? "pharosd says " + health.state : health.state + ": " + health.message;
}

Light sees_light(const SourceHealth* health, const SourceRow& row, std::int64_t now_ns) {
  const std::int64_t silent_ns = now_ns - row.heard_ns;
  if (silent_ns > kSilent_ns) {
    std::string reason = fmt::format("no message for {:.1f} s", static_cast<double>(silent_ns) * kSPerNs);
    if (health != nullptr && health->state != "ok") reason += "; " + daemon_words(*health);
    return {LightLevel::kBad, reason};
  }
  if (health != nullptr && health->state == "degraded") return {LightLevel::kDegraded, daemon_words(*health)};
  return {LightLevel::kGood, "messages arrive"};
}

Light calibrated(const SourceTable& table, const SourceKey& key, const SourceRow& row) {
  if (has_flag(row, "uncalibrated")) {
    return {LightLevel::kDegraded, "the station's calibration is not known yet: a degree and more off is normal"};
  }
  const Sights* sights = table.sights_of(key);
  if (sights != nullptr && !sights->calibrated) {
    return {LightLevel::kDegraded, "angles come without the station's calibration"};
  }
  if (!row.any()) return {LightLevel::kUnknown, "no valid value yet"};
  if (sights != nullptr) return {LightLevel::kGood, "angles are calibrated"};
  return {LightLevel::kGood, "no flag against it"};
}

Light geometry_known(const SourceRow& row) {
  if (row.status == "ambiguous") return {LightLevel::kDegraded, "two poses fit nearly as well; both are drawn"};
  if (has_flag(row, "no_connector")) {
    return {LightLevel::kDegraded, "connector not found: the turn about the ring's axis is not known"};
  }
  if (!row.any()) return {LightLevel::kUnknown, is_refused(row) ? refusal_words(row.status) : "no valid value yet"};
  if (is_refused(row)) return {LightLevel::kUnknown, refusal_words(row.status)};
  if (row.status == "conflict") return {LightLevel::kDegraded, "two sources contradict each other"};
  return {LightLevel::kGood, "one solution"};
}

Light estimate_good(const SourceRow& row, std::int64_t now_ns) {
  if (!row.any()) return {LightLevel::kBad, is_refused(row) ? refusal_words(row.status) : "no valid value yet"};
  if (!row.current(now_ns)) {
    std::string reason =
        fmt::format("LOST: no valid value for {:.1f} s", static_cast<double>(now_ns - row.valid_ns) * kSPerNs);
    if (is_refused(row)) reason += "; " + refusal_words(row.status);
    return {LightLevel::kBad, reason};
  }
  if (row.fused && (row.status == "lost" || row.status == "searching")) return {LightLevel::kBad, row.status};
  if (is_refused(row)) return {LightLevel::kDegraded, refusal_words(row.status)};
  const bool good = row.status == "ok" || (row.fused && (row.status == "fused" || row.status == "single"));
  if (!good) return {LightLevel::kDegraded, row.status};
  // `prior` only tells that the last pose was the start of this one.
  if (!row.flags.empty() && row.flags != "prior") return {LightLevel::kDegraded, row.flags};
  if (row.pose) {
    return {LightLevel::kGood, fmt::format("sigma {:.2f} mm, {:.3f} deg", row.pose->sigma_pos_m * kMmPerM,
                                           row.pose->sigma_rot_rad * kDegPerRad)};
  }
  return {LightLevel::kGood, "ok"};
}

}  // namespace

Lights lights_of(const SourceTable& table, const SourceKey& key, const SourceRow& row, std::int64_t now_ns) {
  return {sees_light(table.health_of(key), row, now_ns), calibrated(table, key, row), geometry_known(row),
          estimate_good(row, now_ns)};
}

const char* name_of(LightLevel level) {
  switch (level) {
    case LightLevel::kGood:
      return "good";
    case LightLevel::kDegraded:
      return "degraded";
    case LightLevel::kBad:
      return "bad";
    case LightLevel::kUnknown:
      break;
  }
  return "unknown";
}

}  // namespace pharos::tools
