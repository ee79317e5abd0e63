// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>

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
};

/// One GigE Vision camera, held and streaming. Everything of Aravis and GLib is in its .cpp file. One thread only.
class GigeCamera {
 public:
  /// Finds, takes, sets and starts the camera: mode, format (Coord3D_ABCY16, else Coord3D_C16 and Mono16 in turns; of a
  /// grey camera as asked), packets; then reads scale and offset. Throws CameraError. Takes up to 3.5 s where no camera
  /// answers.
  explicit GigeCamera(const CameraSettings& settings);
  ~GigeCamera();

  /// Waits for the next frame. `missing` grows by the frames that the camera numbered and of which nothing came.
  FrameOutcome next(DepthFrame& frame, std::chrono::milliseconds timeout, std::int64_t& missing);

  /// False once the camera heeds another program, or none.
  bool is_controller() const;
  /// Whether its clock is led by PTP now; asks the camera.
  bool follows_ptp() const;
  /// Vendor, model, serial number, mode, format, packets.
  const std::string& identity() const;
  /// Where it was found, for a quicker way back to it.
  const std::string& address() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace pharos::host
