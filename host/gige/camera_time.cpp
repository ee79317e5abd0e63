// SPDX-License-Identifier: Apache-2.0
#include "host/gige/camera_time.hpp"

#include <cmath>

#include "host/gige/device_feature.hpp"
#include "host/gige/gobject.hpp"
#include "host/runtime/now.hpp"

namespace pharos::host {

// Node names of the current standard, in ns, and of its first version, in ticks.
CameraTime::CameraTime(ArvDevice* device) : device_(device) {
  if (has_feature(device, "TimestampLatch") && has_feature(device, "TimestampLatchValue")) {
    latch_ = "TimestampLatch";
    value_ = "TimestampLatchValue";
  } else if (has_feature(device, "GevTimestampControlLatch") && has_feature(device, "GevTimestampValue")) {
    latch_ = "GevTimestampControlLatch";
    value_ = "GevTimestampValue";
    ArvError error;
    const double frequency_hz =
        static_cast<double>(arv_device_get_integer_feature_value(device, "GevTimestampTickFrequency", error.out()));
    if (error || frequency_hz < 1.0) {
      latch_ = nullptr;
    } else {
      ns_per_tick_ = 1e9 / frequency_hz;
    }
  }
}

void CameraTime::read() {
  if (latch_ == nullptr) return;
  ArvError error;
  const std::int64_t before_ns = monotonic_now_ns();
  arv_device_execute_command(device_, latch_, error.out());
  if (error) return;
  const std::int64_t after_ns = monotonic_now_ns();
  const gint64 ticks = arv_device_get_integer_feature_value(device_, value_, error.out());
  if (error || ticks <= 0) return;
  known_ = true;
  camera_ns_ = std::llround(static_cast<double>(ticks) * ns_per_tick_);
  read_ns_ = before_ns + (after_ns - before_ns) / 2;
}

bool CameraTime::read_again(std::int64_t now_ns) {
  if (now_ns - read_ns_ < kMinReading_ns) return false;
  read();
  return true;
}

bool CameraTime::agrees(std::int64_t camera_ns, std::int64_t arrival_monotonic_ns) {
  if (!known_ || foreign_ >= kForeignFrames) return true;
  const std::int64_t off_ns = (camera_ns - camera_ns_) - (arrival_monotonic_ns - read_ns_);
  if (off_ns >= -kTolerance_ns && off_ns <= kTolerance_ns) {
    agreed_ = true;
    return true;
  }
  if (!agreed_) ++foreign_;
  return false;
}

}  // namespace pharos::host
