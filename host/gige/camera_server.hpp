// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <string>

#include "host/camera_link/camera_message.hpp"
#include "host/camera_link/frame_slots.hpp"
#include "host/gige/gige_camera.hpp"

namespace pharos::host {

/// A GigE Vision camera that may be missing, taken or lost at any time and is tried again until it comes: the work of
/// pharos-camera. Opens it (which waits for the network), unpacks its frames into the memory shared with pharosd and
/// tells of them over the socket.
class CameraServer {
 public:
  /// Throws std::system_error where the memory is none or too small.
  CameraServer(const CameraSettings& settings, int socket, int memory);
  /// Until the other end of the socket is closed.
  void run();

 private:
  void look_for_camera();
  void stream(GigeCamera& camera);
  FrameOutcome take_frame(GigeCamera& camera);
  bool two_senders(std::int64_t now_ns);
  void count(FrameOutcome outcome, std::int64_t missing);
  void hand_over(FrameNotice& notice);
  void ask(GigeCamera& camera, std::int64_t now_ns);
  void set_state(CameraState state, const std::string& error);
  void report();
  void report_if_due();
  bool send(const CameraMessage& message) const;
  bool pause(std::chrono::milliseconds duration);

  CameraSettings settings_;
  int socket_;
  bool has_depth_;
  FrameSlotWriter slots_;
  bool stopped_ = false;
  std::string last_address_;  // where a camera known by its serial number was last
  bool believe_source_port_ = true;
  std::int64_t discarded_before_ = 0;  // datagrams, of former sessions
  std::int64_t asked_ns_ = 0;
  std::deque<std::int64_t> foreign_ns_;  // when frames came that cannot be the camera's
  bool follows_ptp_ = false;
  std::int64_t passed_over_ = 0;  // frames whose number had been passed, of this session
  CameraReport report_;
  std::int64_t reported_ns_ = 0;
};

}  // namespace pharos::host
