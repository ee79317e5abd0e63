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

/// The work of pharos-camera: operates one GigE Vision camera, which may be missing, in use by another program or lost
/// at any time, and is then tried again. Opens the camera (which waits for the network), unpacks its frames into the
/// memory shared with pharosd and sends notices of them over the socket.
class CameraServer {
 public:
  /// Throws std::system_error if the memory is missing or too small.
  CameraServer(const CameraSettings& settings, int socket, int memory);
  /// Returns when the other end of the socket is closed.
  void run();

 private:
  void look_for_camera();
  void stream(GigeCamera& camera);
  FrameOutcome take_frame(GigeCamera& camera);
  bool two_senders(std::int64_t now_ns);
  void count(FrameOutcome outcome, std::int64_t missing);
  void hand_over(FrameNotice& notice);
  void ask(GigeCamera& camera, std::int64_t now_ns);
  void take_ptp(PtpState state);
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
  std::string last_address_;  // last address of a camera that is configured by its serial number
  bool believe_source_port_ = true;
  std::int64_t discarded_before_ = 0;  // datagrams in previous sessions
  std::int64_t asked_ns_ = 0;
  std::deque<std::int64_t> foreign_ns_;  // times of frames that cannot be the camera's
  std::int64_t passed_over_ = 0;         // frames of this session that Aravis dropped for their number
  CameraReport report_;
  std::int64_t reported_ns_ = 0;
};

}  // namespace pharos::host
