// SPDX-License-Identifier: Apache-2.0
#include "host/frame_record/recorded_camera.hpp"

#include <chrono>
#include <utility>

#include "host/support/input_error.hpp"

namespace pharos::host {
namespace {

std::string words_of(std::int32_t width_px, std::int32_t height_px, bool has_depth) {
  return std::to_string(width_px) + " x " + std::to_string(height_px) + (has_depth ? " with depth" : " grey");
}

}  // namespace

RecordedCamera::RecordedCamera(std::vector<std::filesystem::path> files, const CameraSettings& settings,
                               std::shared_ptr<ReplayTimeline> timeline, ReplaySpeed speed)
    : files_(std::move(files)),
      settings_(settings),
      timeline_(std::move(timeline)),
      speed_(speed),
      reader_(open(files_.at(0))) {
  status_.state = CameraState::kOpen;
  status_.session = 1;
  status_.identity = "recorded frames of " + reader_.header().camera;
  player_ = timeline_->add(reader_.header().monotonic_ns);
  read_next();
  timer_.start(std::chrono::nanoseconds(0));
}

FrameReader RecordedCamera::open(const std::filesystem::path& file) const {
  FrameReader reader{ByteSource(file.string())};
  const FramesHeader& head = reader.header();
  const bool depth = settings_.format == CameraFormat::kDepth;
  if (head.width_px != settings_.width_px || head.height_px != settings_.height_px || head.has_depth != depth) {
    throw InputError(file.string() + ": holds frames of " + words_of(head.width_px, head.height_px, head.has_depth) +
                     ", the camera's are " + words_of(settings_.width_px, settings_.height_px, depth) +
                     "; is it of this camera?");
  }
  return reader;
}

void RecordedCamera::read_next() {
  if (free_.empty()) free_.push_back(std::make_unique<DepthFrame>());
  bool found = false;
  do {
    found = reader_.next(*free_.back());
  } while (!found && open_next_file());
  if (!found) {
    timeline_->end(player_);
    return;
  }
  next_ = std::move(free_.back());
  free_.pop_back();
  timeline_->set_next(player_, next_->complete_monotonic_ns);
}

// False behind the last file. A file that cannot be read is counted and told.
bool RecordedCamera::open_next_file() {
  while (++file_ < files_.size()) {
    try {
      FrameReader next = open(files_[file_]);
      of_read_files_.frames_missing += reader_.counters().frames_missing;
      of_read_files_.frames_bad_time += reader_.counters().frames_bad_time;
      of_read_files_.dropped_bytes += reader_.counters().dropped_bytes;
      reader_ = std::move(next);
      return true;
    } catch (const InputError& error) {
      ++files_unreadable_;
      status_.remark = error.what();
    }
  }
  return false;
}

DepthFramePtr RecordedCamera::take() {
  if (timer_.take_expiries() == 0) return nullptr;
  if (!next_) {
    timer_.stop();
    status_.finished = true;
    status_.state = CameraState::kSilent;
    status_.error = "the recorded frames have come to their end";
    return nullptr;
  }
  const bool full = speed_ == ReplaySpeed::kFastest && in_use_ >= kMaxInUse;
  const std::int64_t wait_ns = full ? ReplayTimeline::kNotYourTurn_ns : timeline_->wait_ns(player_);
  timer_.start(std::chrono::nanoseconds(wait_ns));
  if (wait_ns > 0) return nullptr;
  DepthFramePtr frame = std::move(next_);
  timeline_->played(frame->complete_monotonic_ns,
                    frame->arrival_utc_ns + frame->complete_monotonic_ns - frame->arrival_monotonic_ns);
  ++status_.counters.frames_received;
  ++in_use_;
  read_next();
  return frame;
}

void RecordedCamera::recycle(DepthFramePtr frame) {
  --in_use_;
  free_.push_back(std::move(frame));
}

FrameSourceStatus RecordedCamera::status() const {
  FrameSourceStatus status = status_;
  status.counters.frames_wrong_time = of_read_files_.frames_bad_time + reader_.counters().frames_bad_time;
  status.recording = FrameRecordingCounters{status_.counters.frames_received,
                                            of_read_files_.frames_missing + reader_.counters().frames_missing,
                                            static_cast<std::int64_t>(file_) + 1, 0, files_unreadable_};
  return status;
}

}  // namespace pharos::host
