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

/// A GigE Vision camera that a process of its own holds, because its packets are parsed by foreign code on an open
/// port.
///
/// Starts pharos-camera, copies whole frames out of the memory that both share, starts it again when it dies. What the
/// process says is taken as outside bytes: decoded by decode_camera_message, sizes held against the settings. One
/// thread, the loop's, and the one that made it must live as long as it does.
class CameraSource final : public FrameSource {
 public:
  /// `program`: of camera_program(). Throws std::system_error where this computer gives no memory or descriptor; a
  /// program that cannot be started is tried again, and told.
  CameraSource(const CameraSettings& settings, std::string program);
  ~CameraSource() override;

  /// Frames that may wait: one is worked on while the next comes. The newest win: a longer queue would only make poses
  /// older.
  static constexpr std::size_t kMaxWaiting = 2;
  /// Before a process that died is started again: doubled at each death from the first to the last, and back to the
  /// first after one that lived for kGoodLife.
  static constexpr std::chrono::milliseconds kFirstBackOff{200};
  static constexpr std::chrono::milliseconds kLastBackOff{5000};
  static constexpr std::chrono::seconds kGoodLife{10};

  int fd() const override { return epoll_.get(); }
  DepthFramePtr take() override;
  void recycle(DepthFramePtr frame) override;
  FrameSourceStatus status() const override;
  std::string device() const override;

  /// Of the process that runs now, for tests; -1 where none does.
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
  UniqueFd epoll_;  // of the socket, the timer and what waits: the one descriptor that the loop watches
  Timer restart_;
  ReadyEvent ready_;
  std::unique_ptr<CameraProcess> process_;
  std::int64_t started_ns_ = 0;
  std::chrono::milliseconds back_off_ = kFirstBackOff;

  std::deque<FrameNotice> waiting_;
  std::vector<DepthFramePtr> free_frames_;
  FrameSourceStatus status_;
  FrameSourceCounters of_dead_;     // what former processes had counted
  FrameSourceCounters of_process_;  // what the present one says
  std::uint32_t process_session_ = 0;
  std::uint64_t last_sequence_ = 0;
  std::string last_words_;
};

/// That camera, with the program that is installed. Throws InputError where it is missing.
std::unique_ptr<FrameSource> open_camera(const CameraSettings& settings);

}  // namespace pharos::host
