// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/pointing_feed.hpp"

#include <utility>

#include "host/support/input_error.hpp"

namespace pharos::host {

PointingFeed::PointingFeed(const SourceContext& context, const PointingConfig& config)
    : context_(context),
      config_(config),
      log_(config.name),
      pipeline_(config, context.publisher, context.clock),
      watch_(config.directory),
      worker_(pointing_worker(config.camera)) {
  context_.loop.watch(watch_.fd(), [this] { on_files(); });
  context_.loop.watch(worker_.fd(), [this] { on_results(); });
}

PointingFeed::~PointingFeed() {
  context_.loop.forget(watch_.fd());
  context_.loop.forget(worker_.fd());
}

std::optional<PointingFeed::TrackState> PointingFeed::track_state() const {
  std::error_code error;
  TrackState state;
  state.written = std::filesystem::last_write_time(config_.track_file, error);
  if (error) return std::nullopt;
  state.size = std::filesystem::file_size(config_.track_file, error);
  return error ? std::nullopt : std::optional(state);
}

// Images wait for their rows of the track file; a file that has not changed has no new rows.
void PointingFeed::match(bool always) {
  if (!pipeline_.is_waiting()) return;
  const auto state = track_state();
  if (!state || (!always && state == track_)) return;
  track_ = state;
  const std::int64_t now_ns = context_.clock.monotonic_ns();
  try {
    const pointing::TrackFile track =
        pointing::read_track(ByteSource(config_.track_file.string()), LastLine::kDropUnfinished);
    for (ImageJob& job : pipeline_.match(track, now_ns)) {
      job.with_picture = context_.preview_due(pipeline_.source());
      post(std::move(job));
    }
  } catch (const InputError& error) {
    pipeline_.track_failed(error.what(), now_ns);
  }
}

void PointingFeed::post(PointingJob job) {
  if (const auto discarded = worker_.post(std::move(job))) pipeline_.dropped(*discarded);
}

void PointingFeed::on_files() {
  const std::string track_name = config_.track_file.filename().string();
  for (const std::string& name : watch_.take()) {
    if (name != track_name) pipeline_.arrived(name);
  }
  match(true);
}

void PointingFeed::on_results() {
  while (auto done = worker_.take()) {
    const std::int64_t now_ns = context_.clock.monotonic_ns();
    if (auto* image = std::get_if<ImageResult>(&done->answer)) {
      const std::optional<PointingReport> report = pipeline_.done(*image, now_ns);
      if (report && context_.previews != nullptr) context_.previews->take(*report, std::move(image->pictures));
    } else {
      pipeline_.done(std::get<PassResult>(done->answer), now_ns);
    }
  }
  attend();
}

void PointingFeed::attend() {
  const std::int64_t monotonic_ns = context_.clock.monotonic_ns();
  watch_.attend();
  if (watch_.error() != last_logged_) {
    last_logged_ = watch_.error();
    if (last_logged_.empty()) {
      log_.info("watch", "watching " + config_.directory.string(), monotonic_ns);
    } else {
      log_.warn("watch", last_logged_, monotonic_ns);
    }
  }
  match(false);
  if (auto pass = pipeline_.take_finished_pass(monotonic_ns)) post(std::move(*pass));
}

std::vector<SourceHealth> PointingFeed::health() {
  SourceHealth health = pipeline_.health(context_.clock.monotonic_ns());
  health.device = config_.directory.string();
  health.counters.push_back({"directory_overflows", watch_.overflows()});
  if (!watch_.watching()) {
    health.state = SourceState::kGone;
    health.message = watch_.error();
  }
  return {std::move(health)};
}

std::size_t open_pointing_feeds(const SourceContext& context, SourceList& sources) {
  for (const PointingConfig& telescope : context.config.telescopes) {
    sources.push_back(std::make_unique<PointingFeed>(context, telescope));
  }
  return context.config.telescopes.size();
}

}  // namespace pharos::host
