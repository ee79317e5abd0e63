// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "host/daemon/byte_feed.hpp"
#include "host/daemon/calibration_memory.hpp"
#include "host/daemon/lighthouse_pipeline.hpp"
#include "host/daemon/source.hpp"
#include "host/record/stream_recorder.hpp"

namespace pharos::host {

/// One target of the configuration: passes the bytes of its port or recording to its pipeline, and to a recording if
/// configured.
class LighthouseFeed final : public Source {
 public:
  /// `memory` is shared by all targets. Throws InputError if the file to replay is not a recording.
  LighthouseFeed(const SourceContext& context, const TargetConfig& config, CalibrationMemory& memory);

  const std::string& name() const override { return name_; }
  void attend() override;
  void reconfigure() override;
  std::vector<SourceHealth> health() override;
  bool finished() const override { return bytes_->finished(); }
  std::string clock_notice() const override { return pipeline_->clock_notice(bytes_->monotonic_now()); }
  StorageError storage_error() const override;

 private:
  std::unique_ptr<ByteFeed> open(const TargetConfig& config);
  void on_bytes(std::span<const std::uint8_t> bytes, const Arrival& arrival);

  const SourceContext& context_;
  std::string name_;
  std::optional<StreamRecorder> recorder_;
  std::unique_ptr<ByteFeed> bytes_;
  std::optional<LighthousePipeline> pipeline_;
};

/// Opens every [[target]], and the calibrations that they share across restarts.
std::size_t open_target_feeds(const SourceContext& context, SourceList& sources);

}  // namespace pharos::host
