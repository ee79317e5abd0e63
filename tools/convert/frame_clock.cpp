// SPDX-License-Identifier: Apache-2.0
#include "tools/convert/frame_clock.hpp"

#include <algorithm>
#include <cmath>

#include "tools/convert/lower_envelope.hpp"

namespace pharos::convert {
namespace {

constexpr double kBoardTick_s = 1.0 / 24e6;
constexpr std::size_t kMinFrames = 100;
constexpr double kMaxClockError = 0.05;
constexpr std::size_t kMaxLight = 256;  // of a sensor in three turns, all 16 stations and reflections
// Offsets are rounded to four ticks, and the two clocks differ by less than 1e-5 of a turn.
constexpr double kSameLight_s = 0.5e-6;

// Seconds of the board's clock since the first frame; stamps of 32 bits wrap.
std::vector<double> board_times(const std::vector<LightFrame>& frames) {
  std::vector<double> out;
  std::int64_t ticks = 0;
  std::uint32_t before = frames.front().stamp_ticks;
  for (const LightFrame& frame : frames) {
    ticks += static_cast<std::int32_t>(frame.stamp_ticks - before);
    before = frame.stamp_ticks;
    out.push_back(static_cast<double>(ticks) * kBoardTick_s);
  }
  return out;
}

// Slope of y over x by least squares; 0 where x does not tell one.
double slope_of(const std::vector<double>& x, const std::vector<double>& y) {
  const double n = static_cast<double>(x.size());
  double mx = 0.0, my = 0.0, xx = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    mx += x[i] / n;
    my += y[i] / n;
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mx) * (x[i] - mx);
    xy += (x[i] - mx) * (y[i] - my);
  }
  return xx > 0.0 ? xy / xx : 0.0;
}

}  // namespace

FrameClock::FrameClock(const std::vector<LightFrame>& frames) {
  if (frames.size() < kMinFrames) return;
  const std::vector<double> board_s = board_times(frames);
  std::vector<double> logged_s, delay_s;
  for (const LightFrame& frame : frames) logged_s.push_back(frame.time_s);
  const double rate = slope_of(board_s, logged_s);
  if (!(std::abs(rate - 1.0) < kMaxClockError) || !std::is_sorted(logged_s.begin(), logged_s.end())) return;
  rate_ = rate;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    delay_s.push_back(logged_s[i] - rate * board_s[i]);
    if (frames[i].sensor < light_.size()) light_[frames[i].sensor].push_back({board_s[i], logged_s[i]});
  }
  delay_s_ = lower_envelope(logged_s, delay_s);
  board_s_ = board_s;
  // Frames of several sensors are logged up to some ticks out of order.
  for (std::size_t i = 1; i < board_s_.size(); ++i) board_s_[i] = std::max(board_s_[i], board_s_[i - 1]);
  for (std::vector<Light>& light : light_) {
    std::stable_sort(light.begin(), light.end(), [](const Light& a, const Light& b) { return a.board_s < b.board_s; });
  }
}

std::vector<double> FrameClock::light_of(std::uint8_t sensor, double from_s, double to_s) const {
  std::vector<double> out;
  if (sensor >= light_.size()) return out;
  const std::vector<Light>& light = light_[sensor];
  auto at = std::lower_bound(light.begin(), light.end(), from_s,
                             [](const Light& l, double time_s) { return l.logged_s < time_s; });
  for (; at != light.end() && at->logged_s <= to_s && out.size() < kMaxLight; ++at) out.push_back(at->board_s);
  return out;
}

bool FrameClock::saw(std::uint8_t sensor, double board_s) const {
  if (sensor >= light_.size()) return false;
  const std::vector<Light>& light = light_[sensor];
  const auto at = std::lower_bound(light.begin(), light.end(), board_s - kSameLight_s,
                                   [](const Light& l, double time_s) { return l.board_s < time_s; });
  return at != light.end() && at->board_s < board_s + kSameLight_s;
}

double FrameClock::log_s(double board_s) const {
  const auto after = std::lower_bound(board_s_.begin(), board_s_.end(), board_s);
  const auto place = static_cast<std::size_t>(after - board_s_.begin());
  return rate_ * board_s + delay_s_[std::min(place, delay_s_.size() - 1)];
}

}  // namespace pharos::convert
