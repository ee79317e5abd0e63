// SPDX-License-Identifier: Apache-2.0
#include "tools/convert/crazyflie_sweeps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "pharos/base/units.hpp"
#include "tools/convert/lower_envelope.hpp"

namespace pharos::convert {
namespace {

constexpr double kGroup_s = 0.003;  // angles of one group are logged within 0.4 ms; groups follow after 8 ms and more
constexpr double kLh1Period_s = 1.0 / 60.0;
// Ticks of 48 MHz of one turn, by channel.
constexpr std::array<int, 16> kLh2Period_ticks = {959000, 957000, 953000, 949000, 947000, 943000, 941000, 939000,
                                                  937000, 929000, 919000, 911000, 907000, 901000, 893000, 887000};
constexpr double kLh2Tick_s = 1.0 / 48e6;
// From the later plane's last hit to the least delayed logs: the decoder waits for the next sweep of any station.
constexpr double kLh2Delay_s = 0.002;
// Turns are counted over gaps up to this: a clock 5 % off is then half a turn wrong at most.
constexpr double kCountable_s = 0.15;
constexpr double kLargestRate = 0.05;
constexpr double kFollow = 0.05;

using Key = std::array<std::uint8_t, 2>;  // sensor, plane
using Angles = std::map<Key, double>;

/// Angles of one station after a turn.
struct Block {
  double logged_s = 0.0;
  Angles logged;
  Angles angles;         // those that are new: what a sensor did not see keeps its last value
  double begin_s = 0.0;  // of the turn, LH1: of the slot of plane 0
};

using Blocks = std::map<std::uint8_t, std::vector<Block>>;  // by station

bool begins_group(const LoggedAngle& before, const LoggedAngle& angle) {
  const auto key = [](const LoggedAngle& a) { return std::array{a.sensor, a.station, a.plane}; };
  return angle.time_s - before.time_s > kGroup_s || key(angle) <= key(before);
}

/// Blocks that have an angle that the station's block before has not.
Blocks new_blocks(const std::vector<LoggedAngle>& logged, std::size_t& repeated) {
  Blocks blocks;
  for (std::size_t i = 0; i < logged.size();) {
    std::map<std::uint8_t, Angles> group;
    const double logged_s = logged[i].time_s;
    do {
      group[logged[i].station][{logged[i].sensor, logged[i].plane}] = logged[i].angle_rad;
      ++i;
    } while (i < logged.size() && !begins_group(logged[i - 1], logged[i]));
    for (const auto& [station, angles] : group) {
      std::vector<Block>& before = blocks[station];
      Block block{logged_s, angles, angles, 0.0};
      if (!before.empty()) {
        std::erase_if(block.angles, [&last = before.back().logged](const auto& angle) {
          const auto found = last.find(angle.first);
          return found != last.end() && found->second == angle.second;
        });
      }
      repeated += angles.size() - block.angles.size();
      if (!block.angles.empty()) before.push_back(std::move(block));
    }
  }
  return blocks;
}

/// Time of a hit since the turn's begin (LH1: since that of plane 0's slot), in turns.
double turns_of(int generation, std::uint8_t plane, double angle_rad) {
  if (generation == 1) return 0.5 * plane + (angle_rad + kPi / 2) / kTwoPi;
  return (angle_rad + kPi + (plane == 0 ? -kPi / 3 : kPi / 3)) / kTwoPi;
}

/// From the turn's begin to the instant after which a block can be logged, in turns.
double turns_until_logged(int generation, const Angles& angles) {
  if (generation == 1) return 1.0;
  double last = 0.0;
  for (const auto& [key, angle_rad] : angles) last = std::max(last, turns_of(generation, key[1], angle_rad));
  return last;
}

/// Seconds of the log's clock a second of the rotors: time over counted turns.
double clock_rate_of(const std::vector<Block>& blocks, double period_s) {
  double time_s = 0.0, turns = 0.0;
  double rate = 1.0;
  for (int round = 0; round < 3; ++round) {
    time_s = turns = 0.0;
    for (std::size_t i = 1; i < blocks.size(); ++i) {
      const double step_s = blocks[i].begin_s - blocks[i - 1].begin_s;
      if (!(step_s > 0.0) || step_s > kCountable_s) continue;
      const double counted = std::round(step_s / (period_s * rate));
      if (counted < 1.0) continue;
      time_s += step_s;
      turns += counted;
    }
    if (turns > 0.0) rate = std::clamp(time_s / (turns * period_s), 1.0 - kLargestRate, 1.0 + kLargestRate);
  }
  return rate;
}

/// Takes the delays out of the turns' begins: evenly spaced turns, less the least delay around.
void take_out_delays(std::vector<Block>& blocks, double turn_s) {
  std::vector<double> times_s, delays_s;
  double phase_s = blocks.empty() ? 0.0 : blocks.front().begin_s;
  double usual_s = 0.0;   // delay, slowly followed: a small error of turn_s adds up
  std::size_t first = 0;  // of the present run without a long gap
  const auto close = [&](std::size_t last) {
    const std::vector<double> min_s = lower_envelope(times_s, delays_s);
    for (std::size_t i = first; i < last; ++i) blocks[i].begin_s -= delays_s[i - first] - min_s[i - first];
    times_s.clear();
    delays_s.clear();
  };
  double before_s = phase_s;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const double begin_s = blocks[i].begin_s;
    if (begin_s - before_s > 4.0 * kCountable_s || begin_s < before_s) {
      close(i);
      first = i;
      phase_s = begin_s;
      usual_s = 0.0;
    }
    before_s = begin_s;
    phase_s += std::round((begin_s - phase_s - usual_s) / turn_s) * turn_s;
    times_s.push_back(blocks[i].logged_s);
    delays_s.push_back(begin_s - phase_s);
    usual_s += kFollow * (delays_s.back() - usual_s);
  }
  close(blocks.size());
}

}  // namespace

double rotor_period_s(int generation, int channel) {
  if (generation == 1) return kLh1Period_s;
  return kLh2Period_ticks[static_cast<std::size_t>(std::clamp(channel, 0, 15))] * kLh2Tick_s;
}

CrazyflieSweeps sweeps_of(const CrazyflieLog& log, int generation) {
  CrazyflieSweeps out;
  Blocks blocks = new_blocks(log.angles, out.repeated);
  double weight = 0.0, rates = 0.0;
  for (auto& [station, list] : blocks) {
    const double period_s = rotor_period_s(generation, station);
    for (Block& block : list) {
      block.begin_s = block.logged_s - turns_until_logged(generation, block.logged) * period_s;
    }
    const double count = static_cast<double>(list.size());
    rates += count * clock_rate_of(list, period_s);
    weight += count;
  }
  out.clock_rate = weight > 0.0 ? rates / weight : 1.0;
  for (auto& [station, list] : blocks) {
    const double turn_s = rotor_period_s(generation, station) * out.clock_rate;
    const double delay_s = generation == 1 ? 0.0 : kLh2Delay_s;
    for (Block& block : list) {
      block.begin_s = block.logged_s - delay_s - turns_until_logged(generation, block.logged) * turn_s;
    }
    take_out_delays(list, turn_s);
    for (const Block& block : list) {
      for (const auto& [key, angle_rad] : block.angles) {
        const double theta_rad = generation == 1 ? angle_rad + kPi / 2 : angle_rad;
        out.hits.push_back(
            {block.begin_s + turns_of(generation, key[1], angle_rad) * turn_s, station, key[1], key[0], theta_rad});
      }
    }
  }
  std::stable_sort(out.hits.begin(), out.hits.end(),
                   [](const LightHit& a, const LightHit& b) { return a.time_s < b.time_s; });
  return out;
}

Target lighthouse_deck() {
  Target target;
  constexpr double kX_m = 0.015, kY_m = 0.0075;
  std::uint8_t number = 0;
  for (const double x : {-kX_m, kX_m}) {
    for (const double y : {kY_m, -kY_m}) target.push_back({number++, {x, y, 0.0}, Vector3::UnitZ()});
  }
  return target;
}

}  // namespace pharos::convert
