// SPDX-License-Identifier: Apache-2.0
#include "host/config/load_device.hpp"

#include <arpa/inet.h>

#include <string>

#include "host/config/config_parts.hpp"

namespace pharos::host {
namespace {

constexpr std::int64_t kMinPacket = 576;  // every IPv4 network passes this size
constexpr std::int64_t kMaxPacket = 65'000;
constexpr std::size_t kMaxSerial = 16;  // of GigE Vision

bool is_address(const std::string& text) {
  in_addr parsed{};
  return ::inet_pton(AF_INET, text.c_str(), &parsed) == 1;
}

}  // namespace

void read_which_camera(const TomlTable& table, const char* instead, CameraSettings& device, ConfigErrors& errors) {
  errors.attempt([&] {
    device.serial = table.text_or("serial", "");
    if (table.has("serial") &&
        (device.serial.size() > kMaxSerial || !all_of_set(device.serial, "-_") || device.serial.empty())) {
      table.fail("serial", "must be 1 to " + std::to_string(kMaxSerial) + " letters, digits, - or _");
    }
  });
  errors.attempt([&] {
    device.address = table.text_or("address", "");
    if (table.has("address") && !is_address(device.address)) {
      table.fail("address", "\"" + device.address + "\" is no IPv4 address, as 169.254.1.2");
    }
  });
  errors.attempt([&] {
    if (table.has("serial") || table.has("address")) return;
    table.fail("serial", "is missing; give serial or address of a camera, or " + std::string(instead));
  });
}

void read_transport(const TomlTable& table, CameraSettings& device, ConfigErrors& errors) {
  errors.attempt([&] {
    device.packet_size = static_cast<int>(table.integer_or("packet_size", device.packet_size, kMinPacket, kMaxPacket));
  });
  errors.attempt([&] { device.ptp = table.boolean_or("ptp", device.ptp); });
}

void read_frame_rate(const TomlTable& table, CameraSettings& device) {
  device.frame_rate_hz = table.number_or("frame_rate_hz", device.frame_rate_hz, {0.1, 100.0});
}

void refuse_beside_frames(const TomlTable& table, std::initializer_list<const char*> keys, ConfigErrors& errors) {
  for (const char* key : keys) {
    errors.attempt([&] {
      if (table.has(key)) table.fail(key, "is of a camera on the network; remove it, or remove frames");
    });
  }
}

}  // namespace pharos::host
