// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "host/daemon/source.hpp"
#include "host/daemon/source_state_log.hpp"
#include "host/daemon/stereo/pair_source.hpp"
#include "host/daemon/stereo/pair_worker.hpp"
#include "host/daemon/stereo/stereo_pipeline.hpp"

namespace pharos::host {

/// One rig of the configuration: passes its pairs to a worker for each system and the results to that system's
/// pipeline, and logs errors.
class StereoFeed final : public Source {
 public:
  /// Throws InputError if recorded pairs, rig or vocabulary cannot be used.
  StereoFeed(const SourceContext& context, const StereoConfig& config);
  ~StereoFeed() override;

  const std::string& name() const override { return name_; }
  void attend() override;
  void reconfigure() override {
    for (const auto& system : systems_) system->pipeline.set_publish(context_.config.publish);
  }
  std::vector<SourceHealth> health() override;
  bool finished() const override { return finished_; }
  std::string clock_notice() const override { return pairs_->clock_notice(clock_.monotonic_ns()); }
  StorageError storage_error() const override { return {"recording", pairs_->storage_error()}; }

 private:
  struct System {
    StereoPipeline pipeline;
    PairWorker worker;
  };

  void add_system(const StereoConfig& config, const char* word, const std::shared_ptr<PairEstimator>& estimator);
  void watch_pairs();
  void forget_pairs();
  bool idle() const;
  void on_readable();
  void on_results(System& system);
  void release(StereoPairPtr pair);
  void finish_when_all_answered();

  const SourceContext& context_;
  std::string name_;
  SourceStateLog state_log_;
  const Clock& clock_;
  std::unique_ptr<PairSource> pairs_;
  bool watched_ = false;  // the pairs' descriptors by the loop
  std::vector<std::unique_ptr<System>> systems_;
  bool finished_ = false;
};

/// Opens every [[stereo]].
std::size_t open_stereo_feeds(const SourceContext& context, SourceList& sources);

}  // namespace pharos::host
