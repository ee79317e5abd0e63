// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/lighthouse_pipeline.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include "host/calibrate/calibration_file.hpp"
#include "host/config/live_changes.hpp"
#include "host/publish/messages.hpp"
#include "host/publish/words.hpp"
#include "pharos/base/ticks.hpp"

namespace pharos::host {
namespace {

// A target whose clock goes back by more than any reordering on the line has restarted.
constexpr std::int64_t kRestart_ticks = kTicksPerSecond;

constexpr const char* kWrongTarget = "wrong_target";
constexpr const char* kNotIntroduced = "the board has not said yet who it is, and a certain one is expected";

std::string version_text(const wire::Hello& hello) {
  return std::to_string(hello.firmware_major) + '.' + std::to_string(hello.firmware_minor) + '.' +
         std::to_string(hello.firmware_patch);
}

ReportedBearing reported(const track::TrackedBearing& bearing, std::int64_t cycle_ticks) {
  ReportedBearing report;
  report.sensor = bearing.raw.sensor;
  report.axis = bearing.axis;
  report.width_ticks = bearing.raw.width_ticks;
  report.offset_ns = ticks_to_nanoseconds(bearing.raw.time_ticks - cycle_ticks);
  report.raw_theta_rad = bearing.raw.theta_rad;
  report.ideal_theta_rad = bearing.ideal_theta_rad;
  report.used = bearing.used;
  report.residual_rad = bearing.used ? bearing.residual_rad : 0.0;
  return report;
}

// The result of the tracker or the board as a report without its time.
template <class Report, class JobResult>
Report report_of(const JobResult& answer) {
  Report report;
  if (answer.pose) {
    report.pose = *answer.pose;
    report.ambiguous = report.pose.ambiguous();
  } else {
    report.refusal = pose::name_of(answer.pose.error());
  }
  report.flags = flag_words(answer.flags);
  if (!answer.pose && answer.pose.error() == pose::Refusal::kSuspectTarget) add_flag_word(report.flags, kSuspectWord);
  report.observations = answer.observations;
  return report;
}

tracking::StationSurvey survey_of(const TargetConfig& config) {
  return {config.calibrated_stations, config.calibrated_pair ? &*config.calibrated_pair : nullptr};
}

tracking::MethodOptions options_of(const TargetConfig& config) {
  return {config.method, config.track, config.systematic, config.limits};
}

tracking::CalibrationPolicy policy_of(const tracking::StationSurvey& survey) {
  tracking::CalibrationPolicy policy;
  policy.survey = &survey;
  return policy;
}

}  // namespace

LighthousePipeline::LighthousePipeline(const TargetConfig& config, const PublishConfig& publish,
                                       const std::string& source, Publisher& publisher, const Clock& clock,
                                       CalibrationMemory& memory, int line_baud)
    : config_(config),
      publish_(publish),
      source_(source),
      host_clock_(clock),
      memory_(memory),
      survey_(survey_of(config_)),
      tracker_(policy_of(survey_), config_.target, options_of(config_)),
      line_baud_(line_baud),
      gate_(publisher, counters_.cycles_not_finite,
            PublishGate::AgeLimit{publish.max_age_ns(), counters_.cycles_stale}),
      board_gate_(publisher, counters_.cycles_not_finite,
                  PublishGate::AgeLimit{publish.max_age_ns(), counters_.cycles_stale}),
      log_(config.name),
      identity_fault_(config.identity.any() ? kNotIntroduced : ""),
      changes_(DeliveryMonitor::kOutOfSight_ns) {
  if (config_.generation == 2) world_.emplace(config_.stations, config_.target);
  if (!config_.remember_calibrations) return;
  lighthouse::CalibrationStore accepted;
  for (const lighthouse::StationCalibration& station : memory_.stations()) accepted.remember(station);
  tracker_.resume(accepted);
}

void LighthousePipeline::set_publish(const PublishConfig& publish) {
  publish_ = publish;
  gate_.set_max_age(publish.max_age_ns());
  board_gate_.set_max_age(publish.max_age_ns());
}

void LighthousePipeline::recalibrate(const TargetConfig& config) {
  if (same_calibration(config, config_)) return;  // the tracker need not start again
  take_calibration(config, config_);
  survey_ = survey_of(config_);
  tracker_.rebuild(config_.target, options_of(config_));
  if (world_) world_.emplace(config_.stations, config_.target);
}

void LighthousePipeline::push(std::span<const std::uint8_t> bytes, const Arrival& arrival) {
  if (bytes.empty()) return;
  arrival_ = arrival;
  push_began_ns_ = host_clock_.monotonic_ns();
  last_bytes_ns_ = arrival.monotonic_ns;
  for (const std::uint8_t byte : bytes) {
    ++frame_bytes_;
    if (const auto event = link_.push(byte)) handle(*event);
    // Reset at dropped frames too: only the frame's own bytes have certainly been on the line since it began.
    if (byte == wire::kFrameDelimiter) frame_bytes_ = 0;
  }
  delivery_.on_link(link_.counters(), arrival.monotonic_ns);
  log_foreign_version();
}

void LighthousePipeline::handle(const report::LinkEvent& event) {
  rate_.on_data(arrival_.monotonic_ns);
  check_clock(event);
  std::visit([this](const auto& value) { take(value); }, event);
}

void LighthousePipeline::check_clock(const report::LinkEvent& event) {
  const auto ticks = report::newest_ticks(event);
  if (!ticks) return;
  // A single wrong time is not a restart; two in a row are required.
  const bool back = any_ticks_ && *ticks < newest_ticks_ - kRestart_ticks;
  if (back && time_went_back_) restart("its clock went back");
  time_went_back_ = back && any_ticks_;
  const std::size_t frame_bytes = std::min(frame_bytes_, wire::kMaxLineFrame);
  const bool taken = clock_.add(*ticks, arrival_.utc_ns, arrival_.monotonic_ns, line_time_ns(frame_bytes, line_baud_));
  if (taken) {
    newest_ticks_ = any_ticks_ ? std::max(newest_ticks_, *ticks) : *ticks;
    any_ticks_ = true;
  }
  if (clock_step_.update(clock_, arrival_.monotonic_ns)) {
    log_.warn("host clock", clock_step_.notice(arrival_.monotonic_ns), arrival_.monotonic_ns);
  }
}

// Everything based on the old clock and the old slot numbers is invalid.
void LighthousePipeline::restart(const char* why) {
  log_.info("restart", std::string("target started anew (") + why + ')', arrival_.monotonic_ns);
  ++counters_.target_restarts;
  clock_.restart();
  tracker_.restart();
  if (world_) world_->restart();
  delivery_.restart();
  board_counters_ = {};
  any_ticks_ = false;
}

void LighthousePipeline::line_lost() {
  link_.restart();
  frame_bytes_ = 0;
  tracker_.restart_tracking();
  if (config_.identity.any()) identity_fault_ = kNotIntroduced;
}

// Counted and logged once: a station was moved, or the calibration is older than the stations' position.
void LighthousePipeline::check_relative_pose() {
  const bool refused = tracker_.tracker().relative_pose_rejected();
  if (refused && !relative_pose_rejected_) {
    ++counters_.station_pairs_refused;
    log_.warn("stations moved",
              "the two stations do not stand as " + config_.calibration_file.string() +
                  " says: how they stand is learnt anew from what both see; calibrate again",
              arrival_.monotonic_ns);
  }
  relative_pose_rejected_ = refused;
}

bool LighthousePipeline::state_changed(std::int64_t monotonic_ns) {
  return changes_.update(rate_, delivery_.assess(monotonic_ns), last_refusal_, log_, monotonic_ns);
}

void LighthousePipeline::end_of_input() {
  while (const auto result = tracker_.flush()) answer(*result);
  if (!world_) return;
  world_->flush();
  answer_world();
}

void LighthousePipeline::take(const lighthouse::Sweep& sweep) {
  ++counters_.sweeps;
  if (sweep.flash.station >= kMaxStations) {
    ++counters_.sweeps_bad_station;
    return;
  }
  last_sweep_ns_ = arrival_.monotonic_ns;
  delivery_.on_sweep(sweep.flash, arrival_.monotonic_ns);
  if (const auto result = tracker_.push(sweep)) answer(*result);
  check_relative_pose();
}

void LighthousePipeline::take(const lighthouse::OotxPayload& payload) {
  ++counters_.ootx_payloads;
  switch (tracker_.push(payload)) {
    case lighthouse::CalibrationStore::Verdict::kUnreadable:
      ++counters_.ootx_unreadable;
      return;
    case lighthouse::CalibrationStore::Verdict::kFirstTime:
    case lighthouse::CalibrationStore::Verdict::kUnchanged:
      return;
    case lighthouse::CalibrationStore::Verdict::kTakenIntoUse:
      break;
  }
  const lighthouse::StationCalibration* calibration = tracker_.sent().in_use(payload.station);
  if (calibration == nullptr) return;
  ++counters_.calibrations_taken;
  if (!config_.calibration_file.empty() && tracker_.effective_calibration(payload.station) == calibration) {
    log_.warn("other station",
              "station " + station_id_text(calibration->id) + " is not in " + config_.calibration_file.string() +
                  ": what it sends of itself is used; calibrate with it",
              arrival_.monotonic_ns);
  }
  log_.info("calibration",
            "calibration of station " + std::to_string(payload.station) + " (" + station_id_text(calibration->id) +
                ") in use",
            arrival_.monotonic_ns);
  if (config_.remember_calibrations) memory_.keep(*calibration);
}

void LighthousePipeline::take(const report::DecoderReport& report) { board_counters_.decoder.take(report.counters); }

void LighthousePipeline::take(const report::DeviceReport& report) { board_counters_.device.take(report.counters); }

void LighthousePipeline::take(const report::EdgesReport& edges) {
  counters_.raw_edges += static_cast<std::int64_t>(edges.edges.size());
}

void LighthousePipeline::take(const wire::Time&) {}  // check_clock has used its time

void LighthousePipeline::take(const wire::Hello& hello) {
  const std::pair start{hello.unique_id, hello.start_count};
  if (known_start_ && *known_start_ != start) restart("it says so");
  known_start_ = start;
  check_identity(hello);
  std::string identity = std::string(hello.board.view()) + ' ' + version_text(hello);
  if (hello.unique_id != 0) identity += ' ' + station_id_text(hello.unique_id);
  if (!hello.target.view().empty()) identity += " \"" + std::string(hello.target.view()) + '"';
  if (hello.role == wire::Role::kLoader) identity += " (boot loader)";
  if (hello.role == wire::Role::kSimulator) identity += " (simulated)";
  if (identity == identity_) return;
  identity_ = identity;
  log_.info("identity", identity_ + " speaks", arrival_.monotonic_ns);
}

// Otherwise another target on this port would be measured with this one's sensor positions and reported by its name.
void LighthousePipeline::check_identity(const wire::Hello& hello) {
  const ExpectedIdentity& expected = config_.identity;
  std::string fault;
  if (expected.serial && hello.unique_id != *expected.serial) {
    fault = "the board's serial number is " + station_id_text(hello.unique_id) + ", not " +
            station_id_text(*expected.serial);
  } else if (const int sensors = std::popcount(hello.sensors); expected.sensors && sensors != *expected.sensors) {
    fault = "the board has " + std::to_string(sensors) + " sensors, not " + std::to_string(*expected.sensors);
  }
  if (!fault.empty()) fault += ": another target is on this port; correct the port or [target.identity]";
  if (fault == identity_fault_) return;
  identity_fault_ = fault;
  if (!fault.empty()) log_.error("wrong target", fault, arrival_.monotonic_ns);
}

bool LighthousePipeline::refuse_wrong_target(MeasurementOutcome& outcome) {
  if (identity_fault_.empty()) return false;
  outcome.refusal = kWrongTarget;
  last_refusal_ = kWrongTarget;
  ++counters_.cycles_wrong_target;
  return true;
}

void LighthousePipeline::count_answer(const Result<LighthousePoseEstimate, pose::Refusal>& pose) {
  if (!pose) {
    counters_.count_refusal(pose.error());
    last_refusal_ = pose::name_of(pose.error());
  } else if (pose->ambiguous()) {
    ++counters_.cycles_ambiguous;
  } else {
    ++counters_.cycles_ok;
  }
}

// Sets time, names and flags of a report; false, and counted, while UTC is unknown.
bool LighthousePipeline::stamp_time(MeasurementHeader& report, std::int64_t time_ticks) {
  const auto time = clock_.map(time_ticks);
  if (!time) {
    ++counters_.cycles_no_clock;
    return false;
  }
  report.utc_ns = time->utc_ns;
  report.utc_sigma_ns = time->sigma_ns;
  report.age_ns = arrival_.monotonic_ns - time->monotonic_ns + host_clock_.monotonic_ns() - push_began_ns_;
  report.source = source_;
  report.target = config_.name;
  if (!clock_step_.notice(arrival_.monotonic_ns).empty()) add_flag_word(report.flags, kClockSetWord);
  return true;
}

bool LighthousePipeline::stamp(CycleReport& report, std::uint8_t station, std::int64_t time_ticks) {
  if (!stamp_time(report, time_ticks)) return false;
  report.station = station;
  if (const auto* calibration = tracker_.sent().in_use(station)) report.sensor = station_id_text(calibration->id);
  return true;
}

void LighthousePipeline::answer(const track::EpochResult& result) {
  auto report = report_of<CycleReport>(result);
  if (!gate_.finite(report)) return;
  if (refuse_wrong_target(report)) {
    report.ambiguous = false;
  } else {
    count_answer(result.pose);
  }
  delivery_.on_answer(report.answered(), arrival_.monotonic_ns);
  if (!stamp(report, result.station, result.time_ticks)) return;
  if (report.answered()) calibrate::widen_by_scale(report.pose, config_.scale_sigma);
  if (!gate_.passes(report)) return;
  if (gate_.publish(report) && report.answered()) {
    rate_.on_pose(arrival_.monotonic_ns);
    latency_.add(host_clock_.monotonic_ns() - push_began_ns_);
  }
  if (publish_.bearings) publish_bearings(report, result);
}

void LighthousePipeline::publish_bearings(const CycleReport& report, const track::EpochResult& result) {
  BearingsReport bearings;
  static_cast<MeasurementHeader&>(bearings) = report;
  bearings.station = report.station;
  bearings.calibrated = (result.flags & track::kEpochUncalibrated) == 0;
  const tracking::MethodTracker& tracker = tracker_.tracker();
  for (std::size_t i = 0; i < tracker.bearing_count(); ++i) {
    bearings.bearings.push_back(reported(tracker.bearing(i), result.time_ticks));
  }
  gate_.publish_companion(bearings);
}

void LighthousePipeline::take(const report::PoseReport& pose) {
  ++counters_.board_poses;
  auto report = report_of<BoardPoseReport>(pose);
  if (refuse_wrong_target(report)) report.ambiguous = false;
  if (stamp(report, pose.station, pose.time_ticks)) board_gate_.publish(report);
}

void LighthousePipeline::log_foreign_version() {
  const auto version = link_.unsupported_version();
  if (!version || version == last_logged_version_) return;
  last_logged_version_ = version;
  log_.error("version", unsupported_version_text(*version), arrival_.monotonic_ns);
}

std::string LighthousePipeline::unsupported_version_text(std::uint8_t version) {
  return "the target speaks version " + std::to_string(version) + " of the serial protocol, this daemon version " +
         std::to_string(wire::kProtocolVersion) + ": update the older one";
}

}  // namespace pharos::host
