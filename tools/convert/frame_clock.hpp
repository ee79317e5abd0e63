// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tools/convert/crazyflie_log.hpp"

namespace pharos::convert {

/// When light fell on each sensor, by the decoder board's stamps: one clock for all stations, exact to a tick of 24
/// MHz.
class FrameClock {
 public:
  /// Without frames, or with stamps that do not go with the log's clock to 5 %, it is empty.
  explicit FrameClock(const std::vector<LightFrame>& frames);

  bool empty() const { return board_s_.empty(); }
  double rate() const { return rate_; }  // seconds of the log's clock a second of the board's

  /// Board's times of a sensor's light that was logged between these times of the log, in the order of time.
  std::vector<double> light_of(std::uint8_t sensor, double from_s, double to_s) const;
  /// Whether light fell on a sensor at a time of the board, to the rounding of an offset of a turn.
  bool saw(std::uint8_t sensor, double board_s) const;
  /// A time of the board on the log's clock: a line through all frames, and the least of what the frames around were
  /// delayed by.
  double log_s(double board_s) const;

 private:
  struct Light {
    double board_s = 0.0;
    double logged_s = 0.0;
  };

  double rate_ = 1.0;
  std::array<std::vector<Light>, 32> light_;  // by sensor, in the order of the board's time
  std::vector<double> board_s_;               // of all frames, ascending
  std::vector<double> delay_s_;               // the least around each
};

}  // namespace pharos::convert
