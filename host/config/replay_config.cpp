// SPDX-License-Identifier: Apache-2.0
#include "host/config/replay_config.hpp"

#include "host/record/stream_reader.hpp"
#include "host/support/input_error.hpp"

namespace pharos::host {

DaemonConfig replay_config(const DaemonConfig& config, const std::string& file) {
  const std::string recorded = StreamReader(ByteSource(file)).header().target;
  const TargetConfig* chosen = config.targets.size() == 1 ? &config.targets.front() : nullptr;
  for (const TargetConfig& target : config.targets) {
    if (target.name == recorded) chosen = &target;
  }
  if (chosen == nullptr) {
    throw InputError(file + ": is a recording of target \"" + recorded + "\", which the configuration has not");
  }
  DaemonConfig replay = config;
  static_cast<SourceConfigs&>(replay) = {};
  replay.targets = {*chosen};
  replay.targets.front().port = TargetConfig::kReplayPrefix + file;
  std::erase_if(replay.place_errors, [](const PlaceError& error) { return error.table == "target"; });
  return replay;
}

}  // namespace pharos::host
