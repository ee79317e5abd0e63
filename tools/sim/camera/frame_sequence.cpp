// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/camera/frame_sequence.hpp"

#include <algorithm>
#include <cmath>

#include "host/device/pixel_format.hpp"

namespace pharos::sim {
namespace {

constexpr std::uint16_t kInvalid = 0xFFFF;
constexpr std::size_t kBytesAbcy16 = 8;
constexpr std::size_t kBytes16 = 2;

void put(std::uint8_t* out, std::uint16_t value) {
  out[0] = static_cast<std::uint8_t>(value & 0xFF);
  out[1] = static_cast<std::uint8_t>(value >> 8);
}

std::uint16_t count_of(double metres, const WireScale& wire, std::size_t axis) {
  const double count = std::nearbyint((metres - wire.offset_m[axis]) / wire.scale_m[axis]);
  return count < 0.0 || count >= kInvalid ? kInvalid : static_cast<std::uint16_t>(count);
}

bool valid(std::uint16_t depth) { return depth != 0 && depth != kInvalid; }

std::uint16_t z_count(const FrameSequence& sequence, std::uint16_t depth, const WireScale& wire) {
  return valid(depth) ? count_of(depth * sequence.depth_scale_m, wire, 2) : kInvalid;
}

void write_abcy16(const FrameSequence& sequence, const SequenceFrame& frame, const WireScale& wire,
                  std::span<std::uint8_t> out) {
  std::uint8_t* pixel = out.data();
  for (std::size_t i = 0; i < frame.depth.size(); ++i, pixel += kBytesAbcy16) {
    const bool known = valid(frame.depth[i]) && !sequence.rays.empty();
    const double z_m = frame.depth[i] * sequence.depth_scale_m;
    put(pixel, known ? count_of(z_m * static_cast<double>(sequence.rays[i][0]), wire, 0) : kInvalid);
    put(pixel + 2, known ? count_of(z_m * static_cast<double>(sequence.rays[i][1]), wire, 1) : kInvalid);
    put(pixel + 4, z_count(sequence, frame.depth[i], wire));
    put(pixel + 6, frame.intensity[i]);
  }
}

}  // namespace

void write_payload(const FrameSequence& sequence, const SequenceFrame& frame, std::uint32_t format,
                   const WireScale& wire, std::span<std::uint8_t> out) {
  if (out.size() < host::payload_bytes(format, sequence.width_px, sequence.height_px)) return;
  if (format == host::kCoord3dAbcy16) {
    write_abcy16(sequence, frame, wire, out);
  } else if (format == host::kCoord3dC16) {
    for (std::size_t i = 0; i < frame.depth.size(); ++i)
      put(&out[kBytes16 * i], z_count(sequence, frame.depth[i], wire));
  } else if (format == host::kMono16) {
    for (std::size_t i = 0; i < frame.intensity.size(); ++i) put(&out[kBytes16 * i], frame.intensity[i]);
  } else if (format == host::kMono8) {
    for (std::size_t i = 0; i < frame.intensity.size(); ++i)
      out[i] = static_cast<std::uint8_t>(frame.intensity[i] >> 8);
  } else {
    std::fill(out.begin(), out.end(), std::uint8_t{0});
  }
}

}  // namespace pharos::sim
