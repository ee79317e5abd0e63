// SPDX-License-Identifier: Apache-2.0
#include "host/camera_link/camera_source.hpp"

#include <sys/epoll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include "host/runtime/now.hpp"

namespace pharos::host {
namespace {

// Messages read from a camera's process in one iteration of the event loop; the rest waits for the next one, so that
// other sources are not delayed.
constexpr int kMaxMessagesATurn = 64;

void watch(int epoll, int fd) {
  epoll_event event{};
  event.events = EPOLLIN;
  event.data.fd = fd;
  if (::epoll_ctl(epoll, EPOLL_CTL_ADD, fd, &event) != 0) {
    throw std::system_error(errno, std::generic_category(), "epoll_ctl");
  }
}

FrameSourceCounters sum_of(FrameSourceCounters sum, const FrameSourceCounters& other) {
  std::vector<std::int64_t> values;
  for_each_counter(other, [&](const char*, std::int64_t value) { values.push_back(value); });
  auto value = values.begin();
  for_each_counter(sum, [&](const char*, std::int64_t& total) { total += *value++; });
  return sum;
}

}  // namespace

CameraSource::CameraSource(const CameraSettings& settings, std::string program)
    : settings_(settings),
      program_(std::move(program)),
      slots_(SlotLayout::of(settings)),
      epoll_(::epoll_create1(EPOLL_CLOEXEC)) {
  if (!epoll_.valid()) throw std::system_error(errno, std::generic_category(), "epoll_create1");
  watch(epoll_.get(), restart_.fd());
  watch(epoll_.get(), ready_.fd());
  status_.error = "not opened yet";
  start();
}

CameraSource::~CameraSource() = default;

std::string CameraSource::device() const {
  return settings_.address.empty() ? "camera " + settings_.serial : "camera at " + settings_.address;
}

void CameraSource::start() {
  of_dead_ = sum_of(of_dead_, std::exchange(of_process_, {}));
  process_session_ = 0;
  last_sequence_ = 0;
  last_words_.clear();
  started_ns_ = monotonic_now_ns();
  try {
    process_ = std::make_unique<CameraProcess>(program_, slots_.fd());
    watch(epoll_.get(), process_->fd());
    if (!process_->send(encode(CameraOrder{static_cast<std::int32_t>(::getpid()), settings_}))) on_ended();
  } catch (const std::system_error& error) {
    process_.reset();
    start_later(std::string("the camera's process cannot be started: ") + error.what());
  }
}

void CameraSource::start_later(const std::string& error) {
  status_.state = CameraState::kGone;
  status_.error = error;
  status_.ptp_state = PtpState::kOff;
  const std::int64_t lived_ns = monotonic_now_ns() - started_ns_;
  if (lived_ns > std::chrono::nanoseconds(kGoodLife).count()) back_off_ = kFirstBackOff;
  restart_.start(back_off_);
  back_off_ = std::min(2 * back_off_, kLastBackOff);
}

void CameraSource::on_ended() {
  const std::string cause = process_->kill_and_describe();
  process_.reset();
  waiting_.clear();  // the next process writes into the same memory
  ++status_.counters.camera_process_deaths;
  start_later("the camera's process died: " + cause + (last_words_.empty() ? "" : ", " + last_words_) +
              "; it is started again");
}

void CameraSource::receive() {
  bool ended = false;
  for (int i = 0; i < kMaxMessagesATurn && process_ && !ended; ++i) {
    const auto bytes = process_->receive(ended);
    if (!bytes) break;
    on_message(*bytes);
  }
  if (ended) on_ended();
}

void CameraSource::on_message(const std::vector<std::uint8_t>& bytes) {
  std::optional<CameraMessage> message = decode_camera_message(bytes);
  if (message && std::holds_alternative<FrameNotice>(*message)) {
    on_notice(std::get<FrameNotice>(*message));
  } else if (message && std::holds_alternative<CameraReport>(*message)) {
    on_report(std::get<CameraReport>(*message));
  } else if (message && std::holds_alternative<LastWords>(*message)) {
    last_words_ = std::get<LastWords>(*message).text;
  } else {
    ++status_.counters.messages_refused;
  }
}

void CameraSource::on_notice(FrameNotice& notice) {
  const SlotLayout layout = SlotLayout::of(settings_);
  const bool agreed = notice.about.width_px == layout.width_px && notice.about.height_px == layout.height_px &&
                      notice.has_depth == layout.has_depth;
  // Sequences must increase and times must not be in the future; otherwise the notice is from another process or
  // forged.
  if (!agreed || notice.sequence <= last_sequence_ || notice.about.complete_monotonic_ns > monotonic_now_ns()) {
    ++status_.counters.messages_refused;
    return;
  }
  last_sequence_ = notice.sequence;
  waiting_.push_back(std::move(notice));
  if (waiting_.size() > kMaxWaiting) {
    waiting_.pop_front();
    ++status_.counters.frames_dropped;
  }
}

void CameraSource::on_report(const CameraReport& report) {
  status_.state = report.state;
  status_.error = report.error;
  status_.identity = report.identity;
  status_.ptp_state = report.ptp;
  status_.ptp = text_of(report.ptp);
  status_.ptp_fault = report.ptp_lost || report.ptp == PtpState::kRefused || report.ptp == PtpState::kUnread;
  if (!status_.ptp.empty()) status_.identity += ", " + status_.ptp;
  of_process_ = report.counters;
  // A new process counts its sessions from the start; this counter only increases.
  if (report.session != std::exchange(process_session_, report.session) && report.session != 0) ++status_.session;
}

DepthFramePtr CameraSource::frame_of(const FrameNotice& notice) {
  DepthFramePtr frame = std::make_unique<DepthFrame>();
  if (!free_frames_.empty()) {
    frame = std::move(free_frames_.back());
    free_frames_.pop_back();
  }
  std::vector<std::uint16_t> depth = std::move(frame->depth);
  std::vector<std::uint16_t> intensity = std::move(frame->intensity);
  *frame = notice.about;
  frame->depth = std::move(depth);
  frame->intensity = std::move(intensity);
  frame->session = status_.session;
  if (slots_.copy(notice.sequence, *frame)) return frame;
  recycle(std::move(frame));
  ++status_.counters.frames_dropped;  // newer frames have overwritten it
  return nullptr;
}

DepthFramePtr CameraSource::take() {
  if (restart_.take_expiries() > 0 && !process_) start();
  if (process_) receive();
  DepthFramePtr frame;
  while (!frame && !waiting_.empty()) {
    frame = frame_of(waiting_.front());
    waiting_.pop_front();
  }
  waiting_.empty() ? ready_.clear() : ready_.set();
  return frame;
}

void CameraSource::recycle(DepthFramePtr frame) {
  if (frame) free_frames_.push_back(std::move(frame));
}

FrameSourceStatus CameraSource::status() const {
  FrameSourceStatus status = status_;
  status.counters = sum_of(sum_of(status_.counters, of_dead_), of_process_);
  return status;
}

std::unique_ptr<FrameSource> open_camera(const CameraSettings& settings) {
  return std::make_unique<CameraSource>(settings, camera_program());
}

}  // namespace pharos::host
