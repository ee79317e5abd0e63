// SPDX-License-Identifier: Apache-2.0
#include "host/gige/heartbeat.hpp"

#include "host/gige/gobject.hpp"
#include "host/runtime/now.hpp"

namespace pharos::host {
namespace {

// Bootstrap registers of every GigE Vision device.
constexpr std::uint64_t kHeartbeatTimeoutRegister = 0x0938;
constexpr std::uint64_t kControlPrivilegeRegister = 0x0A00;
constexpr std::uint32_t kTimeout_ms = 1000;
// Three in a row may be lost or late before the camera drops its controller.
constexpr std::int64_t kPeriod_ns = 250'000'000;

}  // namespace

Heartbeat::Heartbeat(ArvDevice* device) : device_(device) {
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
  guint32 ignored_value = 0;
  ArvError ignored;
  arv_device_read_register(device_, kControlPrivilegeRegister, &ignored_value, ignored.out());
}

}  // namespace pharos::host
