// SPDX-License-Identifier: Apache-2.0
#include "host/frame_record/frame_recorder.hpp"

#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "host/record/recording_file.hpp"
#include "host/support/time_units.hpp"
#include "pharos/wire/bytes.hpp"

namespace pharos::host {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kRetry_ns = kNsPerSecond;

std::span<const std::uint8_t> bytes_of(const std::vector<std::uint16_t>& pixels) {
  return {reinterpret_cast<const std::uint8_t*>(pixels.data()), pixels.size() * sizeof(std::uint16_t)};
}

}  // namespace

FrameRecorder::FrameRecorder(FrameRecorderOptions options)
    : options_(std::move(options)), thread_([this] { work(); }) {}

FrameRecorder::~FrameRecorder() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void FrameRecorder::append(const DepthFrame& frame) {
  DepthFrame copy;
  {
    const std::lock_guard lock(mutex_);
    ++sequence_;
    if (waiting_.size() >= kMaxWaiting) {
      ++counters_.frames_lost;
      return;
    }
    if (!free_.empty()) {
      copy = std::move(free_.back());
      free_.pop_back();
    }
  }
  copy = frame;
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back({sequence_, std::move(copy)});
  }
  changed_.notify_one();
}

FrameRecordingCounters FrameRecorder::counters() const {
  const std::lock_guard lock(mutex_);
  return counters_;
}

std::string FrameRecorder::error() const {
  const std::lock_guard lock(mutex_);
  return error_;
}

void FrameRecorder::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return ends_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    Job job = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    const bool written = write(job);
    lock.lock();
    ++(written ? counters_.frames : counters_.frames_lost);
    if (written) error_.clear();
    free_.push_back(std::move(job.frame));
  }
}

bool FrameRecorder::write(const Job& job) {
  const DepthFrame& frame = job.frame;
  const std::int64_t now_ns = frame.complete_monotonic_ns;
  if (fd_.valid()) {
    const double age_s = static_cast<double>(now_ns - file_begun_ns_) / static_cast<double>(kNsPerSecond);
    if (file_bytes_ >= options_.rotate_bytes || age_s >= options_.rotate_s) fd_.reset();
  }
  if (!fd_.valid() && (now_ns < retry_at_ns_ || !open_file(job))) return false;
  FrameNotice notice{job.sequence, !frame.depth.empty(), {}};
  notice.about = frame;  // its pixels are not encoded
  const std::vector<std::uint8_t> head = frame_format::encode_notice(notice);
  std::array<std::uint8_t, frame_format::kCrcBytes> crc{};
  wire::ByteWriter(crc).put(
      frame_format::crc_of(bytes_of(frame.intensity), frame_format::crc_of(bytes_of(frame.depth))));
  for (const auto part : {std::span<const std::uint8_t>(head), bytes_of(frame.depth), bytes_of(frame.intensity),
                          std::span<const std::uint8_t>(crc)}) {
    if (!write_all(fd_.get(), part)) {
      fail(file_.string() + ": cannot be written", errno, now_ns);
      return false;
    }
  }
  holds_frames_ = true;
  file_bytes_ += head.size() + bytes_of(frame.depth).size() + bytes_of(frame.intensity).size() + crc.size();
  return true;
}

bool FrameRecorder::open_file(const Job& job) {
  delete_oldest();
  const DepthFrame& frame = job.frame;
  fd_ = create_recording_file(options_.directory, options_.camera, kFramesSuffix, frame.arrival_utc_ns, file_);
  if (!fd_.valid()) {
    fail(file_.string() + ": cannot be opened", errno, frame.complete_monotonic_ns);
    return false;
  }
  const auto head = frame_format::encode_head({options_.camera, frame.width_px, frame.height_px, !frame.depth.empty(),
                                               frame.arrival_utc_ns, frame.arrival_monotonic_ns});
  holds_frames_ = false;
  file_bytes_ = 0;
  if (!write_all(fd_.get(), head)) {
    fail(file_.string() + ": cannot be written", errno, frame.complete_monotonic_ns);
    return false;
  }
  file_bytes_ = head.size();
  file_begun_ns_ = frame.complete_monotonic_ns;
  const std::lock_guard lock(mutex_);
  ++counters_.files;
  return true;
}

// Makes room for the file that is begun: all files of this camera then stay within the limit.
void FrameRecorder::delete_oldest() {
  std::error_code error;
  if (!fs::is_directory(options_.directory, error)) return;
  const std::vector<fs::path> files = recording_files(options_.directory, options_.camera, kFramesSuffix);
  std::vector<std::uint64_t> sizes;
  std::uint64_t sum = options_.rotate_bytes;
  for (const fs::path& file : files) {
    const std::uint64_t size = fs::file_size(file, error);
    sizes.push_back(error ? 0 : size);
    sum += sizes.back();
  }
  for (std::size_t k = 0; k < files.size() && sum > options_.limit_bytes; ++k) {
    const bool deleted = fs::remove(files[k], error);
    if (deleted) sum -= sizes[k];
    const std::lock_guard lock(mutex_);
    ++(deleted ? counters_.files_deleted : counters_.failures);
  }
}

void FrameRecorder::fail(const std::string& doing, int error, std::int64_t monotonic_ns) {
  // The incomplete frame is removed, and with it a file without any: on a full disk every attempt would leave another.
  std::string more;
  if (fd_.valid()) {
    const bool cleaned =
        holds_frames_ ? ::ftruncate(fd_.get(), static_cast<off_t>(file_bytes_)) == 0 : ::unlink(file_.c_str()) == 0;
    if (!cleaned) more = "; " + file_.string() + (holds_frames_ ? " ends with a broken frame" : " is left without any");
  }
  fd_.reset();
  retry_at_ns_ = monotonic_ns + kRetry_ns;
  const std::lock_guard lock(mutex_);
  ++counters_.failures;
  error_ = doing + ": " + std::strerror(error) + "; the camera is not being recorded" + more;
}

}  // namespace pharos::host
