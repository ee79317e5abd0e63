// SPDX-License-Identifier: Apache-2.0
#include "tools/listen/preview_rows.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "host/support/printable.hpp"
#include "pharos/preview_t.hpp"
#include "tools/listen/pose_rows.hpp"

namespace pharos::tools {

std::string preview_line(const preview_t& preview) {
  return host::printable(fmt::format("{} {} picture of {}{}{}: {}, {} x {} px, {:.1f} KiB", clock_text(preview.utime),
                                     preview.target, preview.source, preview.view.empty() ? "" : " ", preview.view,
                                     preview.status, preview.width_px, preview.height_px,
                                     static_cast<double>(preview.data.size()) / 1024.0));
}

std::string preview_json(const preview_t& preview) {
  const nlohmann::ordered_json out = {{"utime", preview.utime},         {"source", preview.source},
                                      {"target", preview.target},       {"camera", preview.station_or_camera},
                                      {"view", preview.view},           {"sequence", preview.sequence},
                                      {"status", preview.status},       {"width_px", preview.width_px},
                                      {"height_px", preview.height_px}, {"format", preview.format},
                                      {"size", preview.data.size()}};
  return out.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace pharos::tools
