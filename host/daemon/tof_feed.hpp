// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "host/daemon/source.hpp"
#include "host/daemon/source_state_log.hpp"
#include "host/daemon/tof_estimator.hpp"
#include "host/daemon/tof_pipeline.hpp"
#include "host/daemon/tof_worker.hpp"
#include "host/device/frame_source.hpp"

namespace pharos::host {

/// One depth camera of the configuration: passes its frames to a worker and the results to its pipeline, and logs its
/// errors.
class TofFeed final : public Source {
 public:
  /// Throws InputError if recorded frames cannot be used.
  TofFeed(const SourceContext& context, const TofConfig& config);
  ~TofFeed() override;

  const std::string& name() const override { return name_; }
  void attend() override;
  void reconfigure() override { pipeline_.set_publish(context_.config.publish); }
  std::vector<SourceHealth> health() override;
  bool finished() const override { return finished_; }
  std::string clock_notice() const override { return pipeline_.clock_notice(clock_.monotonic_ns()); }
  StorageError storage_error() const override { return {"recording", frames_->storage_error()}; }

 private:
  void watch_frames();
  void forget_frames();
  void on_readable();
  void on_results();

  const SourceContext& context_;
  std::string name_;
  SourceStateLog state_log_;
  const Clock& clock_;
  std::unique_ptr<FrameSource> frames_;
  bool watched_ = false;  // the frames' descriptor by the loop
  TofPipeline pipeline_;
  bool finished_ = false;
  TofEstimator estimator_;
  TofWorker worker_;
};

/// Opens every [[camera]].
std::size_t open_tof_feeds(const SourceContext& context, SourceList& sources);

}  // namespace pharos::host
