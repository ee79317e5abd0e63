// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/fusion/fusion_feed.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "host/support/time_units.hpp"
#include "pharos/fusion/words.hpp"
#include "pharos/pose_t.hpp"

namespace pharos::host {
namespace {

// A recording's silence beyond this has no states.
constexpr std::int64_t kMaxSilence_ns = 20 * kNsPerSecond;

bool is_recorded(const DaemonConfig& config) {
  return std::any_of(config.targets.begin(), config.targets.end(), [](const auto& t) { return t.is_replay(); }) ||
         std::any_of(config.cameras.begin(), config.cameras.end(), [](const auto& c) { return c.replays_camera; }) ||
         std::any_of(config.stereos.begin(), config.stereos.end(), [](const auto& s) { return s.replays_camera; });
}

std::int64_t period_ns(const VehicleConfig& config) { return std::llround(1e9 / config.rate_hz); }

}  // namespace

FusionFeed::FusionFeed(const SourceContext& context, const VehicleConfig& config)
    : context_(context),
      config_(config),
      recorded_(is_recorded(context.config)),
      source_("fusion/" + context.config.source + (recorded_ ? "/replay" : "")),
      log_(name_),
      intake_(config),
      stage_(config),
      gate_(context.publisher, not_finite_, PublishGate::AgeLimit{context.config.publish.max_age_ns(), stale_}) {
  if (!recorded_) {
    worker_ = std::make_unique<Worker>(
        kMaxWaiting, [this](const FusionJob& job) { return stage_.take(job); },
        [](const FusionJob&, const std::string&) { return FusionResult{}; });
    context_.loop.watch(worker_->fd(), [this] { on_results(); });
    context_.loop.watch(timer_.fd(), [this] {
      timer_.take_expiries();
      look();
    });
    start_timer();
  }
  context_.publisher.set_pose_listener([this](const char* channel, const pose_t& message) { take(channel, message); });
}

FusionFeed::~FusionFeed() {
  context_.publisher.set_pose_listener({});
  if (!worker_) return;
  context_.loop.forget(timer_.fd());
  context_.loop.forget(worker_->fd());
}

void FusionFeed::start_timer() { timer_.start_every(std::chrono::nanoseconds(period_ns(config_))); }

void FusionFeed::reconfigure() {
  gate_.set_max_age(context_.config.publish.max_age_ns());
  if (!context_.config.vehicle) return;
  config_.rate_hz = context_.config.vehicle->rate_hz;
  if (worker_) start_timer();
}

void FusionFeed::take(const char* channel, const pose_t& message) {
  std::optional<TakenPose> pose = intake_.take(channel, message);
  const bool several = !intake_.error().empty() && !stations_told_;
  if (several) {
    stations_told_ = true;
    log_.error("stations", intake_.error(), context_.clock.monotonic_ns());
  }
  if (!pose && !several) return;
  if (pose) rate_.on_data(context_.clock.monotonic_ns());
  // What was told in the frame of an unknown station is in the state.
  FusionJob job{0, std::move(pose), several};
  if (recorded_) {
    run_recorded(std::move(job));
  } else {
    job.now_ns = context_.clock.utc_ns();
    run(std::move(job));
  }
}

void FusionFeed::look() { run({context_.clock.utc_ns(), std::nullopt, false}); }

void FusionFeed::run(FusionJob job) {
  const std::optional<FusionJob> dropped = worker_->post(std::move(job));
  if (dropped) ++(dropped->pose ? poses_dropped_ : looks_dropped_);
}

// The rate's states between two poses come before the second one.
void FusionFeed::run_recorded(FusionJob job) {
  if (job.pose) {
    const SourceMounting& mounting = config_.sources[job.pose->source].mounting;
    const std::int64_t time_ns = std::llround((job.pose->row.time_s + mounting.time_offset_s) * 1e9);
    if (newest_ns_ == 0 || time_ns - newest_ns_ > kMaxSilence_ns || newest_ns_ - time_ns > kMaxSilence_ns) {
      next_look_ns_ = time_ns + period_ns(config_);
      newest_ns_ = time_ns;
    }
    for (; next_look_ns_ <= time_ns; next_look_ns_ += period_ns(config_)) {
      const FusionJob look{next_look_ns_, std::nullopt, false};
      done(look, stage_.take(look), 0, 0);
    }
    newest_ns_ = std::max(newest_ns_, time_ns);
  }
  job.now_ns = newest_ns_;
  const std::int64_t began_ns = context_.clock.monotonic_ns();
  const FusionResult result = stage_.take(job);
  done(job, result, 0, context_.clock.monotonic_ns() - began_ns);
}

void FusionFeed::on_results() {
  bool any = false;
  while (const auto result = worker_->take()) {
    any = true;
    done(result->job, result->answer, result->waited_ns, result->took_ns);
  }
  if (any && worker_->idle()) context_.on_finished();
}

void FusionFeed::done(const FusionJob& job, const FusionResult& result, std::int64_t waited_ns, std::int64_t took_ns) {
  if (result.state.sources.empty()) {  // the job threw
    ++faults_;
    return;
  }
  const bool refused = job.pose && result.outcome.refusal != fusion::Refusal::kNone;
  if (job.pose) {
    waiting_.add(waited_ns);
    (result.outcome.late ? late_ : in_order_).add(took_ns);
    poses_late_ += result.outcome.late ? 1 : 0;
    if (refused) ++refused_[static_cast<std::size_t>(result.outcome.refusal)];
  }
  note(result.state);
  last_ = result;
  last_ns_ = context_.clock.monotonic_ns();
  if (!refused) publish(job, result);
}

void FusionFeed::publish(const FusionJob& job, const FusionResult& result) {
  TargetStateReport report;
  report.state = result.state;
  report.names = stage_.names();
  report.risk_per_hour = config_.fusion.risk_per_hour;
  report.utc_ns = job.now_ns;
  report.age_ns = recorded_ ? 0 : context_.clock.utc_ns() - job.now_ns;
  report.source = source_;
  report.target = config_.target;
  if (!result.state.valid) report.refusal = word_of(result.state.mode);
  if (gate_.publish(report) && report.answered()) rate_.on_pose(context_.clock.monotonic_ns());
}

// Each change of the mode, and of what is believed of a source, is told once.
void FusionFeed::note(const fusion::TargetState& state) {
  const std::int64_t now_ns = context_.clock.monotonic_ns();
  if (last_ ? last_->state.mode != state.mode : state.mode != fusion::Mode::kSearching) {
    const bool good = state.mode == fusion::Mode::kFused || state.mode == fusion::Mode::kSingle;
    const std::string text = std::string("mode ") + word_of(state.mode);
    good ? log_.info("mode", text, now_ns) : log_.warn("mode", text, now_ns);
    changed_ = true;
  }
  for (std::size_t s = 0; s < state.sources.size(); ++s) {
    const bool excluded = state.sources[s].state == fusion::SourceState::kExcluded;
    const bool before =
        last_ && s < last_->state.sources.size() && last_->state.sources[s].state == fusion::SourceState::kExcluded;
    if (excluded == before) continue;
    const std::string& source = stage_.names()[s];
    if (excluded) {
      log_.warn("excluded", source + " is excluded: " + word_of(state.sources[s].reason), now_ns);
    } else {
      log_.info("believed", source + " is believed again", now_ns);
    }
    changed_ = true;
  }
}

void FusionFeed::attend() {
  if (!changed_) return;
  changed_ = false;
  context_.on_state_change();
}

std::size_t open_fusion_feed(const SourceContext& context, SourceList& sources) {
  if (!context.config.vehicle) return 0;
  sources.push_back(std::make_unique<FusionFeed>(context, *context.config.vehicle));
  return 1;
}

}  // namespace pharos::host
