// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "host/camera_link/camera_message.hpp"
#include "pharos/wire/crc32.hpp"
#include "support/require.hpp"

namespace {

using namespace pharos::host;
using pharos::test::require;

void check(const FrameNotice& notice) {
  const DepthFrame& frame = notice.about;
  require(notice.sequence > 0 && frame.width_px > 0 && frame.height_px > 0);
  require(frame.width_px <= kMaxFrameSide_px && frame.height_px <= kMaxFrameSide_px);
  require(frame.camera_ns >= 0 && frame.arrival_utc_ns >= 0 && frame.arrival_monotonic_ns >= 0);
  for (std::size_t axis = 0; frame.scale && axis < 3; ++axis) {
    require(std::isfinite(frame.scale->scale_m[axis]) && std::isfinite(frame.scale->offset_m[axis]));
  }
}
void check(const CameraReport& report) {
  require(report.error.size() <= kMaxCameraText_bytes && report.identity.size() <= kMaxCameraText_bytes);
}
void check(const CameraOrder& order) { require(order.parent_pid > 0 && order.settings.packet_size > 0); }
void check(const LastWords& words) { require(words.text.size() <= kMaxCameraText_bytes); }

// Whatever is taken is within its bounds, and is written as the same bytes again.
void check_bytes(std::span<const std::uint8_t> bytes) {
  const auto message = decode_camera_message(bytes);
  if (!message) return;
  std::visit([](const auto& content) { check(content); }, *message);
  const std::vector<std::uint8_t> again = encode(*message);
  require(again.size() == bytes.size() && std::memcmp(again.data(), bytes.data(), bytes.size()) == 0);
}

}  // namespace

// The bytes as they are; and with the head that they should have, so that the search gets past the CRC.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  check_bytes({data, size});
  constexpr std::size_t kHead_bytes = 12;
  if (size < kHead_bytes) return 0;
  std::vector<std::uint8_t> mended(data, data + size);
  constexpr std::uint8_t kKinds = 6;
  mended[6] = static_cast<std::uint8_t>(mended[6] % kKinds);
  mended[7] = 0;
  std::memcpy(mended.data(), "PHCM\2", 6);
  const std::uint32_t crc = pharos::wire::crc32({mended.data() + kHead_bytes, size - kHead_bytes}, mended[6]);
  for (std::size_t i = 0; i < 4; ++i) mended[8 + i] = static_cast<std::uint8_t>(crc >> 8 * i);
  check_bytes(mended);
  return 0;
}
