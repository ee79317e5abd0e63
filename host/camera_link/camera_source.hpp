// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/camera_link/camera_message.hpp"
#include "host/camera_link/camera_process.hpp"
#include "host/camera_link/frame_slots.hpp"
#include "host/device/frame_source.hpp"
#include "host/runtime/timer.hpp"
#include "host/support/ready_event.hpp"
#include "host/support/unique_fd.hpp"

namespace pharos::host {

/// A GigE Vision camera that is operated by a process of its own, because its packets are parsed by third-party code on
/// an open port.
///
/// Starts pharos-camera, copies complete frames out of the shared memory and restarts the process when it dies.
/// Messages of the process are untrusted input: decode_camera_message decodes them, and sizes are compared with the
/// settings. To be used from one thread, the event loop's; the thread that constructs it must live as long as it does.
class CameraSource final : public FrameSource {
 public:
  /// `program`: from camera_program(). Throws std::system_error if memory or a descriptor cannot be had. A program that
  /// cannot be started is reported in status() and tried again.
  CameraSource(const CameraSettings& settings, std::string program);
  ~CameraSource() override;

  /// Maximum number of waiting frames: one is processed while the next arrives. The oldest is dropped, because a longer
  /// queue would only make poses older.
  static constexpr std::size_t kMaxWaiting = 2;
  /// Delay before a process that died is restarted. Each death doubles it, up to kLastBackOff; it is kFirstBackOff
  /// again after a process that ran for kGoodLife.
  static constexpr std::chrono::milliseconds kFirstBackOff{200};
  static constexpr std::chrono::milliseconds kLastBackOff{5000};
  static constexpr std::chrono::seconds kGoodLife{10};

  int fd() const override { return epoll_.get(); }
  DepthFramePtr take() override;
  void recycle(DepthFramePtr frame) override;
  FrameSourceStatus status() const override;
  std::string device() const override;

  /// Process id of the running process, for tests; -1 if none is running.
  int process_id() const { return process_ ? process_->pid() : -1; }

 private:
  void start();
  void on_ended();
  void start_later(const std::string& error);
  void receive();
  void on_message(const std::vector<std::uint8_t>& bytes);
  void on_notice(FrameNotice& notice);
  void on_report(const CameraReport& report);
  DepthFramePtr frame_of(const FrameNotice& notice);

  CameraSettings settings_;
  std::string program_;
  FrameSlotReader slots_;
  UniqueFd epoll_;  // polls the socket, the timer and waiting frames: the one descriptor for the event loop
  Timer restart_;
  ReadyEvent ready_;
  std::unique_ptr<CameraProcess> process_;
  std::int64_t started_ns_ = 0;
  std::chrono::milliseconds back_off_ = kFirstBackOff;

  std::deque<FrameNotice> waiting_;
  std::vector<DepthFramePtr> free_frames_;
  FrameSourceStatus status_;
  FrameSourceCounters of_dead_;     // counts of previous processes
  FrameSourceCounters of_process_;  // counts of the current one
  std::uint32_t process_session_ = 0;
  std::uint64_t last_sequence_ = 0;
  std::string last_words_;
};

/// A CameraSource with the installed program. Throws InputError if the program is missing.
std::unique_ptr<FrameSource> open_camera(const CameraSettings& settings);

}  // namespace pharos::host
