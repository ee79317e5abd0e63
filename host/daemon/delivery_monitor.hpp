// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "host/daemon/delivery_assessment.hpp"
#include "host/daemon/rolling_count.hpp"
#include "host/support/time_units.hpp"
#include "pharos/lighthouse/sweep.hpp"
#include "pharos/wire/link_counters.hpp"

namespace pharos::host {

/// Compares what was received from a lighthouse target in the last ten seconds with what was expected: frames by their
/// sequence numbers, sweeps by the rotors' turns, poses by the number of cycles. Times are monotonic; the state has a
/// fixed size.
class DeliveryMonitor {
 public:
  static constexpr std::int64_t kWindow_s = RollingCount::kWindow_s;
  /// A station that is not seen for longer is out of sight: that is told apart (LOST), and nothing is expected of it.
  static constexpr std::int64_t kOutOfSight_ns = 300'000'000;

  /// Takes the line's counters after each read.
  void on_link(const wire::LinkCounters& link, std::int64_t now_ns);
  void on_sweep(const lighthouse::Flash& flash, std::int64_t now_ns);
  void on_answer(bool pose, std::int64_t now_ns);
  /// The target restarted: its clock and its stations may be others.
  void restart();

  /// kOk, kDegraded or kError. kOk until ten seconds were seen: poses begin only when clock and stations are known.
  DeliveryAssessment assess(std::int64_t now_ns) const;

 private:
  static constexpr std::size_t kStreams = 4;  // two stations, two rotors

  struct Stream {
    std::int64_t sweeps = 0;
    std::int64_t turns = 0;      // of the rotor between these sweeps
    std::int64_t min_turns = 0;  // smallest distance of two sweeps: two turns if stations alternate
  };
  struct Second {
    std::int64_t index = -1;
    DeliveryCount frames;
    DeliveryCount answers;
    std::array<Stream, kStreams> streams;
  };

  Second& second_at(std::int64_t now_ns);
  template <class Visitor>
  void for_each_second(std::int64_t now_ns, Visitor&& visit) const;
  DeliveryCount sweeps(std::int64_t now_ns) const;

  std::array<Second, kWindow_s> seconds_;
  std::array<std::optional<std::int64_t>, kStreams> last_flash_ticks_;
  std::optional<std::int64_t> first_ns_;
  std::int64_t link_frames_ = 0;
  std::int64_t link_lost_ = 0;
};

}  // namespace pharos::host
