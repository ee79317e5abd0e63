// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "host/device/frame_source.hpp"
#include "host/frame_record/frame_format.hpp"
#include "host/support/unique_fd.hpp"

namespace pharos::host {

struct FrameRecorderOptions {
  std::filesystem::path directory;  // created where it does not exist
  std::string camera;
  /// A new file begins at whichever comes first: 14 s of a Helios.
  std::uint64_t rotate_bytes = std::uint64_t{1} << 30;
  double rotate_s = 3600.0;
  /// Of all files of this camera in the directory: the oldest whole ones are deleted for new ones.
  std::uint64_t limit_bytes = std::uint64_t{100} << 30;
};

/// Records a camera's frames without loss of pixels or times into a series of files
/// `CAMERA_YYYYMMDDTHHMMSSZ[_N].phcam`, in a thread of its own: append() copies a frame (0.1 ms for 640 x 480) and
/// never waits for the disk. A frame that finds kMaxWaiting others waiting, or cannot be written, is counted and
/// missing in the recording; writing is tried again once a second. Files end with a whole frame as long as the disk
/// does what it says.
class FrameRecorder {
 public:
  /// A third of a second of a Helios, 10 MB.
  static constexpr std::size_t kMaxWaiting = 8;

  explicit FrameRecorder(FrameRecorderOptions options);
  /// Writes what waits.
  ~FrameRecorder();
  FrameRecorder(const FrameRecorder&) = delete;
  FrameRecorder& operator=(const FrameRecorder&) = delete;

  void append(const DepthFrame& frame);

  FrameRecordingCounters counters() const;
  /// Why nothing is recorded at the moment, one line for the user; empty when there is no error.
  std::string error() const;

 private:
  struct Job {
    std::uint64_t sequence = 0;
    DepthFrame frame;
  };
  // In the thread.
  void work();
  bool write(const Job& job);
  bool open_file(const Job& job);
  void delete_oldest();
  void fail(const std::string& doing, int error, std::int64_t monotonic_ns);

  const FrameRecorderOptions options_;
  UniqueFd fd_;
  std::filesystem::path file_;
  std::uint64_t file_bytes_ = 0;  // head and whole frames only
  bool holds_frames_ = false;
  std::int64_t file_begun_ns_ = 0;
  std::int64_t retry_at_ns_ = 0;

  // Of the caller.
  std::uint64_t sequence_ = 0;

  // Of both.
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Job> waiting_;
  std::vector<DepthFrame> free_;
  FrameRecordingCounters counters_;
  std::string error_;
  bool ends_ = false;

  std::thread thread_;
};

}  // namespace pharos::host
