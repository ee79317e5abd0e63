// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "host/daemon/delivery_assessment.hpp"
#include "host/daemon/rolling_count.hpp"
#include "host/device/frame_source.hpp"

namespace pharos::host {

/// What came of the pictures that cameras should have sent in the last ten seconds, and of the poses that should have
/// been measured in them.
class FrameDelivery {
 public:
  /// `frames`: what a picture is called, in the plural; `lost_where`: what to look at where they are lost.
  FrameDelivery(const char* frames, const char* lost_where) : frames_word_(frames), lost_where_(lost_where) {}

  /// Of the source, from its start until now.
  void on_frames(const DeliveredFrames& total, std::int64_t now_ns);
  /// A picture that was measured, with a pose or without.
  void on_answer(bool pose, std::int64_t now_ns) { answers_.add({pose ? 1 : 0, 1}, now_ns); }

  /// kOk, kDegraded or kError. kOk until ten seconds were seen, and where too few pictures came to tell.
  DeliveryAssessment assess(std::int64_t now_ns) const;

  /// Of fewer no part is told.
  static constexpr std::int64_t kMinExpected = 5;

 private:
  const char* frames_word_;
  const char* lost_where_;
  RollingCount frames_, answers_;
  DeliveredFrames last_;
};

}  // namespace pharos::host
