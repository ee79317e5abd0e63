// SPDX-License-Identifier: Apache-2.0
#include "tools/listen/status_rows.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "host/support/printable.hpp"
#include "pharos/status_t.hpp"

namespace pharos::tools {
namespace {

std::string counters_line(const std::vector<counter_t>& counters) {
  std::string out;
  for (const counter_t& counter : counters) {
    if (counter.value != 0) out += ' ' + host::printable(counter.name) + '=' + std::to_string(counter.value);
  }
  return out.empty() ? out : "\n   " + out;
}

std::string age_text(const char* what, std::int64_t age_us) {
  if (age_us < 0) return std::string("no ") + what + " yet";
  return fmt::format("{} {:.1f} ms old", what, static_cast<double>(age_us) * 1e-3);
}

nlohmann::ordered_json counters_json(const std::vector<counter_t>& counters) {
  nlohmann::ordered_json out = nlohmann::ordered_json::object();
  for (const counter_t& counter : counters) out[counter.name] = counter.value;
  return out;
}

}  // namespace

std::string status_lines(const status_t& status) {
  std::string row = status.host + ' ' + status.version + ": " + status.state;
  if (!status.message.empty()) row += " (" + status.message + ')';
  std::string out = host::printable(row) + counters_line(status.counters);
  for (const source_status_t& source : status.sources) {
    row = source.target + ": " + source.state;
    if (!source.message.empty()) row += " (" + source.message + ')';
    row += ", " + fmt::format("{:.1f} poses/s", source.pose_rate_hz) + ", " + age_text("data", source.data_age_us) +
           ", " + age_text("pose", source.pose_age_us) + ", " + source.device;
    if (!source.identity.empty()) row += ", " + source.identity;
    out += "\n  " + host::printable(row) + counters_line(source.counters);
  }
  return out;
}

std::string status_json(const status_t& status) {
  nlohmann::ordered_json out = {{"utime", status.utime},       {"host", status.host},
                                {"version", status.version},   {"state", status.state},
                                {"message", status.message},   {"uptime_us", status.uptime_us},
                                {"sequence", status.sequence}, {"counters", counters_json(status.counters)}};
  for (const source_status_t& source : status.sources) {
    out["sources"].push_back({{"source", source.source},
                              {"target", source.target},
                              {"state", source.state},
                              {"message", source.message},
                              {"device", source.device},
                              {"identity", source.identity},
                              {"data_age_us", source.data_age_us},
                              {"pose_age_us", source.pose_age_us},
                              {"pose_rate_hz", source.pose_rate_hz},
                              {"clock_sigma_us", source.clock_sigma_us},
                              {"clock_drift_ppm", source.clock_drift_ppm},
                              {"counters", counters_json(source.counters)}});
  }
  return out.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace pharos::tools
