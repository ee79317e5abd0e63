// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pharos/geometry/pose.hpp"
#include "pharos/geometry/target.hpp"
#include "pharos/lighthouse/sweep.hpp"
#include "pharos/report/reporter.hpp"

namespace pharos::host {

/// A capture board on a stationary target with one ideal station: the bytes of its serial line, cycle by cycle.
///
/// Every sensor is hit in every sweep, noise is only the 10 ns grid: the daemon's poses must equal `truth()` to a
/// hundredth of a degree.
class StationaryTarget {
 public:
  using Bytes = std::vector<std::uint8_t>;
  static constexpr std::int64_t kTurn_ticks = 833'333;
  static constexpr std::int64_t kHalfTurn_ticks = 416'667;

  static constexpr std::uint8_t kSensors = 6;
  /// Sensors on two plates of different height, the first six alone determine a pose.
  static Target target(std::uint8_t sensors = kSensors);
  /// The same as a target file's text.
  static std::string target_table(std::uint8_t sensors = kSensors);

  explicit StationaryTarget(const LighthouseFromBody& truth, std::uint8_t sensors = kSensors)
      : truth_(truth), target_(target(sensors)) {}

  const LighthouseFromBody& truth() const { return truth_; }
  /// Both sweeps of the cycle that ends at `end_ticks` of the target's clock (the line's newest instant).
  Bytes cycle(std::int64_t end_ticks);
  /// One sweep with only the first `sensors` of the target.
  lighthouse::Sweep sweep(Axis axis, std::int64_t flash_ticks, std::size_t sensors = kMaxSensors) const;
  Bytes bytes_of(const lighthouse::Sweep& sweep) { return copy(reporter_.report(sweep)); }
  Bytes time(std::int64_t now_ticks) { return copy(reporter_.report_time(now_ticks)); }
  Bytes hello(const char* board, std::int64_t now_ticks = 0, std::uint16_t start_count = 0);
  Bytes counters(std::uint32_t edges_in);
  /// An OOTX payload of an ideal station without any correction.
  Bytes ootx(std::int64_t now_ticks, std::uint32_t id);

 private:
  static Bytes copy(report::Reporter::Bytes bytes) { return {bytes.begin(), bytes.end()}; }

  LighthouseFromBody truth_;
  Target target_;
  report::Reporter reporter_;
};

/// A valid frame of another protocol version.
StationaryTarget::Bytes frame_of_unsupported_version(std::uint8_t version, std::uint16_t sequence);

}  // namespace pharos::host
