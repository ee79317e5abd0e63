// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "host/device/camera_settings.hpp"
#include "host/device/depth_frame.hpp"
#include "host/support/unique_fd.hpp"

namespace pharos::host {

/// Layout of the memory that pharosd and a camera's process share; both compute it from the settings.
///
/// Each slot begins with a page whose first 8 bytes are the sequence number of the frame in the slot, 0 while it is
/// being written. Depth (not for a grey camera) and intensity follow, 16 bits per pixel. Frame n is in slot n mod
/// kSlots.
struct SlotLayout {
  /// Two frames may wait, one is copied, one is written.
  static constexpr std::uint64_t kSlots = 4;

  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
  bool has_depth = false;

  static SlotLayout of(const CameraSettings& settings) {
    return {settings.width_px, settings.height_px, settings.format == CameraFormat::kDepth};
  }
  std::size_t pixels() const { return static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px); }
  std::size_t slot_bytes() const;
  std::size_t bytes() const { return kSlots * slot_bytes(); }
};

/// Memory mapped from a descriptor for the lifetime of this object.
class SharedMapping {
 public:
  /// Throws std::system_error.
  SharedMapping(int fd, std::size_t bytes, bool writable);
  ~SharedMapping();
  SharedMapping(const SharedMapping&) = delete;
  SharedMapping& operator=(const SharedMapping&) = delete;
  std::byte* at(std::size_t offset) const { return start_ + offset; }

 private:
  std::byte* start_;
  std::size_t bytes_;
};

/// Images of a frame that is being filled; depth is empty for a grey camera.
struct FrameImages {
  std::span<std::uint16_t> depth;
  std::span<std::uint16_t> intensity;
};

/// Writer in the camera's process: uses the slots in turn and does not wait for the reader.
class FrameSlotWriter {
 public:
  /// Throws std::system_error, also if the memory is smaller than the layout.
  FrameSlotWriter(int fd, const SlotLayout& layout);
  /// Memory for the next frame. The slot's previous frame becomes invalid.
  FrameImages begin();
  /// Marks the frame as complete and returns its sequence number.
  std::uint64_t publish();

 private:
  SlotLayout layout_;
  SharedMapping memory_;
  std::uint64_t sequence_ = 0;
};

/// Reader in pharosd. The memory is sealed: nobody with its descriptor can shrink or grow it, so that reads in pharosd
/// cannot fault.
class FrameSlotReader {
 public:
  /// Creates the memory. Throws std::system_error.
  explicit FrameSlotReader(const SlotLayout& layout);
  /// Descriptor for the camera's process.
  int fd() const { return fd_.get(); }
  /// Copies the images of frame `sequence` into `frame`. False if another frame is in its slot already, or was written
  /// there during the copy. 0.1 ms for 640 x 480.
  bool copy(std::uint64_t sequence, DepthFrame& frame) const;

 private:
  SlotLayout layout_;
  UniqueFd fd_;
  SharedMapping memory_;
};

}  // namespace pharos::host
