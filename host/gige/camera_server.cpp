// SPDX-License-Identifier: Apache-2.0
#include "host/gige/camera_server.hpp"

#include <poll.h>
#include <sys/socket.h>

#include <exception>
#include <utility>

#include "host/runtime/now.hpp"

namespace pharos::host {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kRetry{250};
constexpr milliseconds kWait{50};
// Minimum time of a wait that ends early without a frame (as when the camera's socket is closed): no busy loop.
constexpr milliseconds kBreath{20};
// Frames come every 33 ms, or every 0.3 s if formats alternate: a camera without frames for this time is lost.
constexpr std::int64_t kSilence_ns = 1'000'000'000;
// PTP's state changes within seconds and clocks drift by microseconds in this time; a query costs the camera four
// packets.
constexpr std::int64_t kAsk_ns = 1'000'000'000;
// More complete frames than this within a second that the camera cannot have sent after the others mean two senders,
// and the camera cannot be distinguished from the other. The stream is opened anew on another port, which the other
// sender does not know.
constexpr std::size_t kMaxForeignFrames = 5;
constexpr std::int64_t kForeignWindow_ns = 1'000'000'000;
constexpr std::int64_t kReportPeriod_ns = 100'000'000;

std::int64_t ns(milliseconds duration) { return std::chrono::nanoseconds(duration).count(); }

}  // namespace

CameraServer::CameraServer(const CameraSettings& settings, int socket, int memory)
    : settings_(settings),
      socket_(socket),
      has_depth_(settings.format == CameraFormat::kDepth),
      slots_(memory, SlotLayout::of(settings)) {}

/// True unless pharosd has closed its end or has ended. pharosd sends nothing after the order.
bool CameraServer::pause(milliseconds duration) {
  pollfd other_end{socket_, POLLIN, 0};
  stopped_ = stopped_ || ::poll(&other_end, 1, static_cast<int>(duration.count())) > 0;
  return !stopped_;
}

bool CameraServer::send(const CameraMessage& message) const {
  const std::vector<std::uint8_t> bytes = encode(message);
  return ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT) > 0;
}

void CameraServer::report() {
  reported_ns_ = monotonic_now_ns();
  send(report_);
}

void CameraServer::report_if_due() {
  if (monotonic_now_ns() - reported_ns_ >= kReportPeriod_ns) report();
}

void CameraServer::set_state(CameraState state, const std::string& error) {
  if (state != CameraState::kOpen) report_.ptp = PtpState::kOff;
  report_.state = state;
  report_.error = error;
  report();
}

void CameraServer::run() {
  while (pause(milliseconds(0))) {
    look_for_camera();
    pause(kRetry);
  }
}

void CameraServer::look_for_camera() {
  CameraSettings settings = settings_;
  // A camera usually comes back at its last address, where it is found without a search of the network; if it is not
  // there, the next attempt searches the network.
  if (settings.address.empty()) settings.address = std::exchange(last_address_, "");
  try {
    GigeCamera camera(settings, believe_source_port_);
    last_address_ = camera.address();
    ++report_.session;
    ++report_.counters.camera_opened;
    report_.identity = camera.identity();
    report_.ptp_lost = false;
    report_.ptp = camera.ptp_state();
    report_.counters.ptp_refusals += report_.ptp == PtpState::kRefused ? 1 : 0;
    set_state(CameraState::kOpen, "");
    stream(camera);
    discarded_before_ = report_.counters.datagrams_discarded;
  } catch (const CameraError& error) {
    set_state(error.state(), error.what());
  } catch (const std::exception& error) {  // a defect of this program: tried again
    set_state(CameraState::kWrong, std::string("internal error: ") + error.what());
  }
}

void CameraServer::stream(GigeCamera& camera) {
  std::int64_t last_ns = monotonic_now_ns();
  bool any = false;
  asked_ns_ = 0;
  foreign_ns_.clear();
  passed_over_ = 0;
  while (pause(milliseconds(0))) {
    const std::int64_t began_ns = monotonic_now_ns();
    const FrameOutcome outcome = take_frame(camera);
    const std::int64_t now_ns = monotonic_now_ns();
    camera.beat_if_due();  // a silent one too, or it would be taken for lost
    const bool foreign = outcome == FrameOutcome::kOutOfOrder || outcome == FrameOutcome::kWrongTime;
    any = any || outcome != FrameOutcome::kNone;
    if (outcome != FrameOutcome::kNone) ask(camera, now_ns);
    if (outcome != FrameOutcome::kNone && !foreign) last_ns = now_ns;
    // Aravis drops frames whose number is below the current one. If another sender's numbers are ahead, these are the
    // camera's own frames.
    const std::int64_t passed_over = camera.frames_passed_over();
    const bool overtaken = passed_over > std::exchange(passed_over_, passed_over);
    if ((foreign || overtaken) && two_senders(now_ns)) break;
    if (now_ns - last_ns > kSilence_ns) break;
    if (outcome == FrameOutcome::kNone && now_ns - began_ns < ns(kBreath)) pause(kBreath);
    report_.counters.datagrams_discarded = discarded_before_ + camera.discarded_datagrams();
    report_if_due();
  }
  // If the camera reports a source port and sends from another one, the filter drops all of its packets.
  believe_source_port_ = any;
  if (stopped_) {
    camera.restore_heartbeat();
    return;
  }
  if (foreign_ns_.size() > kMaxForeignFrames) {
    ++report_.counters.camera_contested;
    set_state(CameraState::kSilent, "frames of two senders come to the camera's port; opening it anew on another");
    return;
  }
  const bool lost = !camera.is_controller();
  ++(lost ? report_.counters.camera_lost : report_.counters.camera_silences);
  set_state(lost ? CameraState::kGone : CameraState::kSilent,
            lost ? "the camera was lost; looking for it" : "no frame comes from the camera; opening it anew");
}

FrameOutcome CameraServer::take_frame(GigeCamera& camera) {
  FrameNotice notice;
  std::int64_t missing = 0;
  const FrameOutcome outcome = camera.next(notice.about, slots_.begin(), kWait, missing);
  count(outcome, missing);
  if (outcome == FrameOutcome::kFrame) hand_over(notice);
  return outcome;
}

// Called after a frame, so that no frame waits for the camera's responses. Not called while no frames come: a query
// without a response takes 2.5 s.
void CameraServer::ask(GigeCamera& camera, std::int64_t now_ns) {
  if (now_ns - asked_ns_ <= kAsk_ns) return;
  asked_ns_ = now_ns;
  take_ptp(camera.ptp_state());
  camera.read_clock();
}

void CameraServer::take_ptp(PtpState state) {
  const PtpState before = std::exchange(report_.ptp, state);
  const bool ceased = before == PtpState::kSlave && state != PtpState::kSlave;
  report_.counters.ptp_losses += ceased ? 1 : 0;
  report_.ptp_lost = state != PtpState::kSlave && (report_.ptp_lost || ceased);
  if (state != before) report();
}

/// Called for each frame that does not fit the others. Whether there are so many that there must be two senders.
bool CameraServer::two_senders(std::int64_t now_ns) {
  foreign_ns_.push_back(now_ns);
  while (now_ns - foreign_ns_.front() > kForeignWindow_ns) foreign_ns_.pop_front();
  return foreign_ns_.size() > kMaxForeignFrames;
}

void CameraServer::count(FrameOutcome outcome, std::int64_t missing) {
  FrameSourceCounters& counters = report_.counters;
  counters.frames_missing += missing;
  counters.frames_received += outcome == FrameOutcome::kFrame ? 1 : 0;
  counters.frames_incomplete += outcome == FrameOutcome::kIncomplete ? 1 : 0;
  counters.frames_wrong_size += outcome == FrameOutcome::kWrongSize ? 1 : 0;
  counters.frames_out_of_order += outcome == FrameOutcome::kOutOfOrder ? 1 : 0;
  counters.frames_wrong_time += outcome == FrameOutcome::kWrongTime ? 1 : 0;
  counters.frames_unpaired += outcome == FrameOutcome::kUnpaired ? 1 : 0;
}

void CameraServer::hand_over(FrameNotice& notice) {
  DepthFrame& frame = notice.about;
  frame.clock = report_.ptp == PtpState::kSlave ? CameraClock::kPtp : CameraClock::kOwn;
  frame.session = report_.session;
  notice.has_depth = has_depth_;
  notice.sequence = slots_.publish();
  // The socket is full because pharosd is delayed; this frame is dropped, as pharosd will need newer ones.
  if (!send(notice)) ++report_.counters.frames_dropped;
}

}  // namespace pharos::host
