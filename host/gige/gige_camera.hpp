// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>

#include "host/camera_link/frame_slots.hpp"
#include "host/device/camera_settings.hpp"
#include "host/device/depth_frame.hpp"
#include "host/device/frame_source.hpp"
#include "host/device/ptp_state.hpp"

namespace pharos::host {

/// Why a camera cannot be used now; the message says what to do.
class CameraError : public std::runtime_error {
 public:
  CameraError(CameraState state, const std::string& message) : std::runtime_error(message), state_(state) {}
  CameraState state() const { return state_; }

 private:
  CameraState state_;
};

/// Outcome of a wait for a frame.
enum class FrameOutcome : std::uint8_t {
  kNone,        // no frame in time
  kFrame,       // the frame was filled in
  kIncomplete,  // packets are missing
  kWrongSize,   // another size or format than configured
  kUnpaired,    // depth without intensity, or the reverse
  kOutOfOrder,  // complete, with a number that cannot follow the last one
  kWrongTime,   // complete, with a time stamp that disagrees with the camera's clock
};

/// One GigE Vision camera, under our control and streaming. Aravis and GLib appear in its .cpp file only. To be used
/// from one thread.
class GigeCamera {
 public:
  /// Frames of a tenth of a second, in which this process may not be scheduled, and those being filled.
  static constexpr int kBuffers = 8;

  /// Finds the camera, takes control, sets mode, format (Coord3D_ABCY16, or Coord3D_C16 and Mono16 alternating; for a
  /// grey camera as configured) and packet size, reads scale and offset, and starts it. Throws CameraError. Takes up to
  /// 3.5 s if no camera responds.
  /// `believe_source_port`: the stream comes from the port in GevSCSP; otherwise the port is learnt from packets.
  explicit GigeCamera(const CameraSettings& settings, bool believe_source_port = true);
  ~GigeCamera();

  /// Waits for the next frame. `images` have the size in the settings; everything else of the frame is stored in
  /// `about`. `missing` is increased by the number of frames of which no packet was received.
  FrameOutcome next(DepthFrame& about, const FrameImages& images, std::chrono::milliseconds timeout,
                    std::int64_t& missing);

  /// False when another program or nobody controls the camera.
  bool is_controller() const;
  /// Whether the camera's clock follows PTP now; queries the camera. kOff if the settings say no.
  PtpState ptp_state() const;
  /// Datagrams to the stream's port that the kernel dropped: by the filter, or for a full buffer.
  std::int64_t discarded_datagrams() const;
  /// Packets that Aravis dropped because their frame number was below the current one, counted in whole frames; 0 if
  /// packets were also dropped for lack of buffers.
  std::int64_t frames_passed_over() const;
  /// Sends the heartbeat, four times a second; does not wait for the answer.
  void beat_if_due();
  /// Reads the camera's clock, with which the times of frames are compared. It queries the camera, so do not call it
  /// while a frame waits.
  void read_clock();
  /// Restores the camera's own heartbeat timeout, before a working camera is released.
  void restore_heartbeat();
  /// Vendor, model, serial number, mode, format, packets.
  const std::string& identity() const;
  /// Address at which it was found, to find it faster next time.
  const std::string& address() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace pharos::host
