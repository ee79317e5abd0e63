// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/preview_stage.hpp"

#include "host/support/time_units.hpp"
#include "pharos/preview_t.hpp"

namespace pharos::host {
namespace {

preview_t message_of(const MeasurementHeader& header, const AnnotatedImage& image, std::vector<std::uint8_t> jpeg) {
  preview_t message{};
  message.utime = header.utc_ns / kNsPerUs;
  message.source = header.source;
  message.station_or_camera = header.sensor;
  message.view = image.view;
  message.target = header.target;
  message.status = status_word(header);
  message.width_px = image.width_px;
  message.height_px = image.height_px;
  message.format = "jpeg";
  message.size = static_cast<std::int32_t>(jpeg.size());
  message.data = std::move(jpeg);
  return message;
}

}  // namespace

PreviewStage::~PreviewStage() {
  if (worker_) loop_.forget(worker_->fd());
}

bool PreviewStage::due(const std::string& source) const {
  if (!config_.previews) return false;
  const auto last = taken_ns_.find(source);
  return last == taken_ns_.end() || clock_.monotonic_ns() - last->second >= kPeriod_ns;
}

void PreviewStage::take(const MeasurementHeader& header, std::vector<AnnotatedImage> images) {
  if (images.empty() || !due(header.source)) return;
  if (!worker_) {
    worker_ = std::make_unique<Worker>(
        kMaxWaiting, [](const Job& job) { return preview_jpeg(job.image); },
        [](const Job&, const std::string&) { return Jpeg(); });
    loop_.watch(worker_->fd(), [this] { on_encoded(); });
  }
  taken_ns_[header.source] = clock_.monotonic_ns();
  for (AnnotatedImage& image : images) {
    if (worker_->post({header, std::move(image)})) ++dropped_;
  }
}

void PreviewStage::on_encoded() {
  while (auto done = worker_->take()) {
    if (done->answer.empty()) {
      ++failed_;
      continue;
    }
    preview_t message = message_of(done->job.header, done->job.image, std::move(done->answer));
    message.sequence = next_sequence_[{message.source, message.view}]++;
    publisher_.publish_preview(message);
  }
}

NamedCounts PreviewStage::named_counts() const {
  return {{"published_previews", publisher_.counters().previews},
          {"previews_dropped", dropped_},
          {"previews_failed", failed_}};
}

}  // namespace pharos::host
