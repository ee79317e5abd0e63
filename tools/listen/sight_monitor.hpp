// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "tools/listen/received_pose.hpp"

namespace pharos::tools {

/// When the valid poses of a source stop, and when they come again. Times are monotonic.
class SightMonitor {
 public:
  /// A received message; returns the row FOUND where it ends an absence that was told, else nothing.
  std::string add(const ReceivedPose& pose, std::int64_t now_ns);
  /// A row LOST for each source whose poses have stopped since the last call.
  std::vector<std::string> lost(std::int64_t utc_ns, std::int64_t now_ns);

 private:
  struct Stream {
    std::string name;  // target and station or camera, as in a pose's row
    std::int64_t last_ns = 0;
    std::int64_t interval_ns = 0;  // between its last two poses; 0: there was one only
    bool lost = false;
  };
  std::map<std::tuple<std::string, std::string, std::string, int>, Stream> streams_;
};

}  // namespace pharos::tools
