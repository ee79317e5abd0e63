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

namespace pharos::host {

/// Why a camera cannot be had now; the message says what to do.
class CameraError : public std::runtime_error {
 public:
  CameraError(CameraState state, const std::string& message) : std::runtime_error(message), state_(state) {}
  CameraState state() const { return state_; }

 private:
  CameraState state_;
};

/// What a wait for a frame ended with.
enum class FrameOutcome : std::uint8_t {
  kNone,        // no frame in time
  kFrame,       // the frame was filled in
  kIncomplete,  // packets are missing
  kWrongSize,   // another size or format than agreed
  kUnpaired,    // depth without intensity, or the reverse
  kOutOfOrder,  // whole, with a number that cannot follow the last one's
  kWrongTime,   // whole, with a time that is not of the camera's clock
};

/// One GigE Vision camera, held and streaming. Everything of Aravis and GLib is in its .cpp file. One thread only.
class GigeCamera {
 public:
  /// A tenth of a second of frames that may arrive while this process is not scheduled, and those being filled.
  static constexpr int kBuffers = 8;

  /// Finds, takes, sets and starts the camera: mode, format (Coord3D_ABCY16, else Coord3D_C16 and Mono16 in turns; of a
  /// grey camera as asked), packets; then reads scale and offset. Throws CameraError. Takes up to 3.5 s where no camera
  /// answers.
  /// `believe_source_port`: what GevSCSP says of the port that its stream comes from holds; else that is learnt.
  explicit GigeCamera(const CameraSettings& settings, bool believe_source_port = true);
  ~GigeCamera();

  /// Waits for the next frame. `images` are of the settings'
  /// size; the rest of the frame goes into `about`. `missing` grows by the frames that the camera numbered and of which
  /// nothing came.
  FrameOutcome next(DepthFrame& about, const FrameImages& images, std::chrono::milliseconds timeout,
                    std::int64_t& missing);

  /// False once the camera heeds another program, or none.
  bool is_controller() const;
  /// Whether its clock is led by PTP now; asks the camera.
  bool follows_ptp() const;
  /// Datagrams to the stream's port that the kernel dropped: not the camera's, or without room.
  std::int64_t discarded_datagrams() const;
  /// Frames' worth of packets so far whose number Aravis had passed already, while it had room: it drops them by
  /// itself.
  std::int64_t frames_passed_over() const;
  /// Tells the camera that its master lives, four times a second; asks it, so not while a frame waits.
  void beat_if_due();
  /// Reads the camera's clock, which its frames' times are held against; not while a frame waits either.
  void read_clock();
  /// Before a camera that is well is given back: its heartbeat timeout as it was found.
  void restore_heartbeat();
  /// Vendor, model, serial number, mode, format, packets.
  const std::string& identity() const;
  /// Where it was found, for a quicker way back to it.
  const std::string& address() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace pharos::host
