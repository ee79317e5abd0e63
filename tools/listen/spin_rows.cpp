// SPDX-License-Identifier: Apache-2.0
#include "tools/listen/spin_rows.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "host/support/printable.hpp"
#include "pharos/base/units.hpp"
#include "pharos/spin_t.hpp"
#include "tools/listen/pose_rows.hpp"

namespace pharos::tools {
namespace {

bool has_axis(const spin_t& spin) { return spin.axis[0] != 0.0 || spin.axis[1] != 0.0 || spin.axis[2] != 0.0; }

}  // namespace

std::string spin_line(const spin_t& spin) {
  std::string out = fmt::format("{} {} spin {}", clock_text(spin.utime), spin.target, spin.status);
  if (spin.valid == 0) return host::printable(out);
  const double rate = std::hypot(spin.rate_rad_s[0], spin.rate_rad_s[1], spin.rate_rad_s[2]);
  out += fmt::format("  {:.4f} +- {:.4f} deg/s", rate * kDegPerRad, spin.sigma_rate_rad_s * kDegPerRad);
  out += has_axis(spin) ? fmt::format(" about ({:.4f}, {:.4f}, {:.4f}) +- {:.3f} deg", spin.axis[0], spin.axis[1],
                                      spin.axis[2], spin.sigma_axis_rad * kDegPerRad)
                        : std::string(" about no axis that can be told");
  return host::printable(out + fmt::format("  {} attitudes in {:.1f} s", spin.attitudes, spin.span_s));
}

std::string spin_json(const spin_t& spin) {
  nlohmann::ordered_json out = {{"utime", spin.utime},       {"source", spin.source},
                                {"target", spin.target},     {"camera", spin.station_or_camera},
                                {"sequence", spin.sequence}, {"reference_frame", spin.reference_frame},
                                {"status", spin.status}};
  const bool valid = spin.valid != 0;
  const auto add = [&out](const char* name, bool known, const nlohmann::ordered_json& value) {
    out[name] = known ? value : nlohmann::ordered_json();
  };
  constexpr double k = kDegPerRad;
  add("rate_deg_s", valid, {k * spin.rate_rad_s[0], k * spin.rate_rad_s[1], k * spin.rate_rad_s[2]});
  nlohmann::ordered_json covariance;
  for (const double value : spin.covariance) covariance.push_back(k * k * value);
  add("covariance_deg2_s2", valid, covariance);
  add("axis", valid && has_axis(spin), {spin.axis[0], spin.axis[1], spin.axis[2]});
  add("sigma_rate_deg_s", valid, k * spin.sigma_rate_rad_s);
  add("sigma_axis_deg", valid && has_axis(spin), k * spin.sigma_axis_rad);
  add("residual_rms_deg", valid, k * spin.residual_rms_rad);
  add("attitudes", valid, spin.attitudes);
  add("span_s", valid, spin.span_s);
  return out.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace pharos::tools
