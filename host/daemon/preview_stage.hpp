// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "host/config/daemon_config.hpp"
#include "host/preview/preview_picture.hpp"
#include "host/publish/health.hpp"
#include "host/publish/measurement_header.hpp"
#include "host/publish/publisher.hpp"
#include "host/runtime/clock.hpp"
#include "host/runtime/event_loop.hpp"
#include "host/runtime/job_worker.hpp"

namespace pharos::host {

/// Pictures of cameras on LCM, where publish.previews asks for them: at most two a second of each source, reduced,
/// drawn and encoded in a thread of their own, which starts with the first one. Used from the event loop's thread.
class PreviewStage {
 public:
  static constexpr std::int64_t kPeriod_ns = 500'000'000;
  /// Pictures that wait for the thread; the oldest gives way.
  static constexpr std::size_t kMaxWaiting = 16;

  /// All must outlive this. `config` may change.
  PreviewStage(EventLoop& loop, Publisher& publisher, const PublishConfig& config, const Clock& clock)
      : loop_(loop), publisher_(publisher), config_(config), clock_(clock) {}
  ~PreviewStage();
  PreviewStage(const PreviewStage&) = delete;
  PreviewStage& operator=(const PreviewStage&) = delete;

  /// Whether pictures of this source would be taken now; only then need they be made.
  bool due(const std::string& source) const;
  /// Takes the pictures (one for each view) of the measurement with this header, unless they are not due.
  void take(const MeasurementHeader& header, std::vector<AnnotatedImage> images);

  NamedCounts named_counts() const;

 private:
  struct Job {
    MeasurementHeader header;
    AnnotatedImage image;
  };
  using Jpeg = std::vector<std::uint8_t>;
  using Worker = JobWorker<Job, Jpeg>;

  void on_encoded();

  EventLoop& loop_;
  Publisher& publisher_;
  const PublishConfig& config_;
  const Clock& clock_;
  std::map<std::string, std::int64_t> taken_ns_;                               // last, by source
  std::map<std::pair<std::string, std::string>, std::int64_t> next_sequence_;  // by source and view
  std::int64_t dropped_ = 0;
  std::int64_t failed_ = 0;  // not encoded
  std::unique_ptr<Worker> worker_;
};

}  // namespace pharos::host
