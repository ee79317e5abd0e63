// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/pointing_pipeline.hpp"

#include <algorithm>
#include <cmath>

#include "host/images/image_names.hpp"
#include "host/publish/messages.hpp"
#include "host/support/time_units.hpp"

namespace pharos::host {
namespace {

constexpr std::size_t kMaxPending = 1024;  // images without a row; beyond this the oldest is dropped
// Range of a 64-bit count of nanoseconds.
constexpr double kMaxTime_s = 9.2e9;

bool is_image(const std::string& name) { return !name.empty() && name[0] != '.' && has_image_ending(name); }

}  // namespace

PointingPipeline::PointingPipeline(const PointingConfig& config, Publisher& publisher, const Clock& clock)
    : config_(config),
      clock_(clock),
      log_(config.name),
      R_earth_station_(pointing::station_to_earth(config.station)),
      gate_(publisher, counters_.pointings_not_finite),
      delivery_("images",
                "their rows do not come, or more come than can be measured: see images_without_track, images_dropped") {
}

void PointingPipeline::arrived(const std::string& name) {
  ++counters_.files_arrived;
  if (!is_image(name)) {
    ++counters_.files_no_image;
    return;
  }
  rate_.on_data(clock_.monotonic_ns());
  if (std::find(pending_.begin(), pending_.end(), name) != pending_.end()) return;
  pending_.push_back(name);
  if (pending_.size() <= kMaxPending) return;
  pending_.pop_front();
  ++counters_.images_without_track;
}

std::vector<ImageJob> PointingPipeline::match(const pointing::TrackFile& track, std::int64_t monotonic_ns) {
  std::vector<ImageJob> jobs;
  // Of several rows of one image the first in the file is used. Jobs are in the order of the track, which is that of
  // time.
  for (std::size_t i = 0; i < track.rows.size(); ++i) {
    const pointing::TrackRow& row = track.rows[i];
    const auto waiting = std::find(pending_.begin(), pending_.end(), row.image);
    if (waiting == pending_.end()) continue;
    pending_.erase(waiting);
    if (row.refusal.empty()) {
      jobs.push_back({config_.directory / row.image, row.observation});
    } else {
      ImageResult gap;
      gap.observation = row.observation;
      gap.refusal = row.refusal;
      gap.advice = row.image + ": its row of " + config_.track_file.string() + " is not complete or out of range";
      refuse(gap, monotonic_ns);
    }
  }
  return jobs;
}

void PointingPipeline::dropped(const PointingJob& job) {
  ++(std::holds_alternative<ImageJob>(job) ? counters_.images_dropped : counters_.passes_dropped);
}

void PointingPipeline::track_failed(const std::string& error, std::int64_t monotonic_ns) {
  ++counters_.track_errors;
  last_error_ = error;
  log_.warn("track", error, monotonic_ns);
}

PointingReport PointingPipeline::report_of(const MeasurementOutcome& outcome, double time_s) const {
  PointingReport report;
  static_cast<MeasurementOutcome&>(report) = outcome;
  report.utc_ns = std::llround(std::clamp(time_s, -kMaxTime_s, kMaxTime_s) * static_cast<double>(kNsPerSecond));
  report.source = source();
  report.sensor = config_.name;
  report.target = config_.target;
  return report;
}

PointingReport PointingPipeline::refuse(const ImageResult& result, std::int64_t monotonic_ns) {
  ++counters_.images_refused;
  delivery_.on_answer(false, monotonic_ns);
  ++counters_.refused[result.refusal];
  last_error_ = result.advice;
  log_.warn(result.refusal.c_str(), "refused_" + result.refusal + ": " + result.advice, monotonic_ns);
  PointingReport refused = report_of(result, result.observation.time_s);
  gate_.publish(refused);
  return refused;
}

std::optional<PointingReport> PointingPipeline::done(const ImageResult& result, std::int64_t monotonic_ns) {
  last_result_ns_ = monotonic_ns;
  if (!result.remark.empty() && !remarked_) log_.info("remark", result.remark, monotonic_ns);
  remarked_ = remarked_ || !result.remark.empty();
  if (!result.answered()) return refuse(result, monotonic_ns);
  PointingReport report = report_of(result, result.observation.time_s);
  report.axis_station = result.axis.axis;
  report.axis_earth = R_earth_station_ * result.axis.axis;
  report.covariance_station = result.axis.covariance;
  report.plane_normal_station = pointing::signed_axis(result.axis.plane.normal);
  report.sigma_plane_rad = result.axis.sigma_plane_rad;
  if (!gate_.passes(report)) return std::nullopt;
  ++counters_.images_ok;
  delivery_.on_answer(true, monotonic_ns);
  last_error_.clear();
  rate_.on_pose(monotonic_ns);
  if (config_.law) keep_for_pass(result);
  gate_.publish(report);
  return report;
}

void PointingPipeline::keep_for_pass(const ImageResult& result) {
  const bool late =
      !pass_.empty() && std::abs(result.observation.time_s - pass_.back().observation.time_s) > config_.pass_gap_s;
  if (late) over_.swap(pass_);
  if (late) pass_.clear();
  // An image whose file arrived late is inserted at its time.
  const auto place = std::upper_bound(
      pass_.begin(), pass_.end(), result.observation.time_s,
      [](double time_s, const pointing::PassImage& image) { return time_s < image.observation.time_s; });
  pass_.insert(place, {result.observation, result.planes_station});
}

std::optional<PassJob> PointingPipeline::take_finished_pass(std::int64_t monotonic_ns) {
  if (!config_.law) return std::nullopt;
  const bool silent =
      !pass_.empty() && pending_.empty() && last_result_ns_ >= 0 &&
      static_cast<double>(monotonic_ns - last_result_ns_) > config_.pass_gap_s * static_cast<double>(kNsPerSecond);
  if (over_.empty() && silent) over_.swap(pass_);
  if (over_.empty()) return std::nullopt;
  PassJob job{{}, {config_.station, *config_.law, pointing::PassOptions{}.max_spin_rad_s}};
  job.images.swap(over_);
  return job;
}

void PointingPipeline::done(const PassResult& result, std::int64_t monotonic_ns) {
  const pointing::PassEstimate& pass = result.estimate;
  PointingReport report = report_of(result, pass.time_s);
  report.from_pass = true;
  report.images = pass.images;
  if (report.answered()) {
    report.ambiguous = pass.second_axis_station.has_value();
    report.axis_station = pass.axis_station;
    report.axis_earth = R_earth_station_ * pass.axis_station;
    report.covariance_station = pass.covariance_station;
    if (!gate_.passes(report)) return;
    ++counters_.passes_ok;
  } else {
    ++counters_.passes_refused;
    log_.warn("pass",
              "pass of " + std::to_string(pass.images) + " images: refused_" + report.refusal +
                  (report.advice.empty() ? "" : ": " + report.advice),
              monotonic_ns);
  }
  gate_.publish(report);
}

SourceHealth PointingPipeline::health(std::int64_t monotonic_ns) {
  SourceHealth health;
  health.source = source();
  health.target = config_.target;
  rate_.report(health, monotonic_ns);
  // No images between passes is normal for a telescope, and not an error.
  health.state = rate_.any_pose() && last_error_.empty() ? SourceState::kOk : SourceState::kWaiting;
  health.message = last_error_;
  if (last_error_.empty() && !rate_.any_pose()) health.message = "no image came yet";
  const PointingCounters& c = counters_;
  delivery_.on_frames({c.images_ok + c.images_refused, c.images_without_track + c.images_dropped}, monotonic_ns);
  if (const DeliveryAssessment delivery = delivery_.assess(monotonic_ns); delivery.state != SourceState::kOk) {
    health.state = delivery.state;
    health.message = delivery.message;
  }
  if (!pending_.empty()) {
    health.message = std::to_string(pending_.size()) + " images wait for their row in " + config_.track_file.string();
  }
  health.counters = {{"files_arrived", c.files_arrived},
                     {"files_no_image", c.files_no_image},
                     {"images_ok", c.images_ok},
                     {"images_refused", c.images_refused},
                     {"images_without_track", c.images_without_track},
                     {"images_dropped", c.images_dropped},
                     {"passes_ok", c.passes_ok},
                     {"passes_refused", c.passes_refused},
                     {"passes_dropped", c.passes_dropped},
                     {"track_errors", c.track_errors},
                     {"pointings_not_finite", c.pointings_not_finite},
                     {"log_lines_held_back", static_cast<std::int64_t>(log_.suppressed())}};
  for (const auto& [reason, count] : c.refused) health.counters.push_back({"refused." + reason, count});
  return health;
}

}  // namespace pharos::host
