// SPDX-License-Identifier: Apache-2.0
#include "host/gige/heartbeat.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <array>

#include "host/gige/gobject.hpp"
#include "host/runtime/now.hpp"

namespace pharos::host {
namespace {

// Bootstrap registers of every GigE Vision device.
constexpr std::uint64_t kHeartbeatTimeoutRegister = 0x0938;
constexpr std::uint32_t kControlPrivilegeRegister = 0x0A00;
constexpr std::uint32_t kTimeout_ms = 1000;
// Three in a row may be lost or late before the camera drops its controller.
constexpr std::int64_t kPeriod_ns = 250'000'000;
constexpr std::uint16_t kControlPort = 3956;
// READREG of the control channel's register, an answer wanted. Its number is the last one that Aravis' counter reaches.
constexpr std::array<std::uint8_t, 12> kReadPrivilege{
    0x42, 0x01, 0x00, 0x80, 0x00, 0x04, 0xFF, 0xFF, 0x00, 0x00, kControlPrivilegeRegister >> 8, 0x00};

}  // namespace

Heartbeat::Heartbeat(ArvDevice* device, std::uint32_t camera_address)
    : device_(device), camera_address_(camera_address), sockets_(udp_sockets()) {
  ArvError error;
  guint32 before_ms = 0;
  if (arv_device_read_register(device, kHeartbeatTimeoutRegister, &before_ms, error.out()) == 0 || error) return;
  if (before_ms <= kTimeout_ms) return;
  arv_device_write_register(device, kHeartbeatTimeoutRegister, kTimeout_ms, error.out());
  if (!error) former_ms_ = before_ms;
}

void Heartbeat::restore() {
  ArvError ignored;
  if (former_ms_ != 0) arv_device_write_register(device_, kHeartbeatTimeoutRegister, former_ms_, ignored.out());
}

void Heartbeat::beat_if_due() {
  const std::int64_t now_ns = monotonic_now_ns();
  if (now_ns - last_beat_ns_ < kPeriod_ns) return;
  last_beat_ns_ = now_ns;
  sockaddr_in camera{};
  camera.sin_family = AF_INET;
  camera.sin_port = htons(kControlPort);
  camera.sin_addr.s_addr = htonl(camera_address_);
  // From a socket that is not the controlling one it is a reader's question, which changes nothing.
  for (const UdpSocket& socket : sockets_) {
    ::sendto(socket.fd, kReadPrivilege.data(), kReadPrivilege.size(), MSG_DONTWAIT | MSG_NOSIGNAL,
             reinterpret_cast<const sockaddr*>(&camera), sizeof camera);
  }
}

}  // namespace pharos::host
