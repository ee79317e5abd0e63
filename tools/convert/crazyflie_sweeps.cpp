// SPDX-License-Identifier: Apache-2.0
#include "tools/convert/crazyflie_sweeps.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "pharos/base/units.hpp"
#include "tools/convert/crazyflie_blocks.hpp"
#include "tools/convert/frame_clock.hpp"
#include "tools/convert/framed_turns.hpp"
#include "tools/convert/lower_envelope.hpp"

namespace pharos::convert {
namespace {

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
constexpr double kEarly = 0.3;      // of a cycle before the usual delay
constexpr double kNextTurns = 2.5;  // a station's next block follows after so many turns at most

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

/// A block among those of all stations that turn together.
struct Counted {
  Block* block = nullptr;
  double shift_s = 0.0;  // of its station's turn within the cycle
};

/// Counts the cycles of blocks in the order in which they were logged: each block's delay after an evenly spaced grid,
/// and the number of its run without a long gap.
void count_cycles(const std::vector<Counted>& blocks, double cycle_s) {
  if (blocks.empty()) return;
  const auto begin_of = [](const Counted& counted) { return counted.block->begin_s - counted.shift_s; };
  double phase_s = begin_of(blocks.front()), before_s = phase_s;
  double usual_s = 0.0;  // delay, slowly followed: a small error of cycle_s adds up
  std::size_t run = 0;
  for (const Counted& counted : blocks) {
    const double begin_s = begin_of(counted);
    if (begin_s - before_s > 4.0 * kCountable_s || begin_s < before_s - cycle_s) {
      ++run;
      phase_s = begin_s;
      usual_s = 0.0;
    }
    before_s = begin_s;
    phase_s += std::round((begin_s - phase_s - usual_s) / cycle_s) * cycle_s;
    const double late_s = begin_s - phase_s;
    // Nothing is logged early: what seems so was logged with the other station's next block.
    counted.block->delay_s = late_s < usual_s - kEarly * cycle_s ? late_s + cycle_s : late_s;
    counted.block->run = run;
    usual_s += kFollow * (late_s - usual_s);
  }
}

/// Takes the delays out of the turns' begins: less what is above the least delay around.
void take_out_delays(std::vector<Block>& blocks) {
  for (std::size_t first = 0, last = 0; first < blocks.size(); first = last) {
    std::vector<double> times_s, delays_s;
    for (last = first; last < blocks.size() && blocks[last].run == blocks[first].run; ++last) {
      times_s.push_back(blocks[last].logged_s);
      delays_s.push_back(blocks[last].delay_s);
    }
    const std::vector<double> min_s = lower_envelope(times_s, delays_s);
    for (std::size_t i = first; i < last; ++i) blocks[i].begin_s -= delays_s[i - first] - min_s[i - first];
  }
}

/// Turns of an LH1 station from one of its blocks to the next: of two stations each sweeps in every second turn.
double turns_apart(const std::vector<Block>& blocks, double turn_s) {
  std::size_t single = 0, counted = 0;
  for (std::size_t i = 1; i < blocks.size(); ++i) {
    const double step = (blocks[i].begin_s - blocks[i - 1].begin_s) / turn_s;
    if (!(step > 0.0) || step > kNextTurns) continue;
    ++counted;
    if (step < 1.5) ++single;
  }
  return 4 * single < counted ? 2.0 : 1.0;
}

LightHit hit_at(int generation, double time_s, std::uint8_t station, const AngleKey& key, double angle_rad) {
  return {time_s, station, key[1], key[0], generation == 1 ? angle_rad + kPi / 2 : angle_rad};
}

/// By the decoder board's stamps.
void time_by_frames(const FrameClock& clock, const Blocks& blocks, CrazyflieSweeps& out) {
  out.clock_rate = clock.rate();
  for (const auto& [station, list] : blocks) {
    for (const FramedHit& hit : framed_hits(clock, rotor_period_s(2, station), list, out.untimed)) {
      out.hits.push_back(hit_at(2, hit.time_s, station, hit.key, hit.angle_rad));
    }
  }
}

/// By the rotors' even turns and the least delays.
void time_by_turns(int generation, Blocks& blocks, CrazyflieSweeps& out) {
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
  double apart = 2.0;
  for (auto& [station, list] : blocks) {
    const double turn_s = rotor_period_s(generation, station) * out.clock_rate;
    const double delay_s = generation == 1 ? 0.0 : kLh2Delay_s;
    for (Block& block : list) {
      block.begin_s = block.logged_s - delay_s - turns_until_logged(generation, block.logged) * turn_s;
    }
    apart = std::min(apart, generation == 1 ? turns_apart(list, turn_s) : 1.0);
  }
  // Two LH1 stations sweep in turn, all others for themselves.
  std::vector<Counted> together;
  for (auto& [station, list] : blocks) {
    const double turn_s = rotor_period_s(generation, station) * out.clock_rate;
    if (apart < 2.0) together.clear();
    for (Block& block : list) together.push_back({&block, apart < 2.0 ? 0.0 : (station % 2) * turn_s});
    if (apart < 2.0) count_cycles(together, turn_s);
  }
  if (apart == 2.0) {
    std::stable_sort(together.begin(), together.end(),
                     [](const Counted& a, const Counted& b) { return a.block->logged_s < b.block->logged_s; });
    count_cycles(together, apart * kLh1Period_s * out.clock_rate);
  }
  for (auto& [station, list] : blocks) {
    const double turn_s = rotor_period_s(generation, station) * out.clock_rate;
    take_out_delays(list);
    for (const Block& block : list) {
      for (const auto& [key, angle_rad] : block.angles) {
        const double time_s = block.begin_s + turns_of(generation, key[1], angle_rad) * turn_s;
        out.hits.push_back(hit_at(generation, time_s, station, key, angle_rad));
      }
    }
  }
}

}  // namespace

double rotor_period_s(int generation, int channel) {
  if (generation == 1) return kLh1Period_s;
  return kLh2Period_ticks[static_cast<std::size_t>(std::clamp(channel, 0, 15))] * kLh2Tick_s;
}

CrazyflieSweeps sweeps_of(const CrazyflieLog& log, int generation) {
  CrazyflieSweeps out;
  Blocks blocks = new_blocks(log.angles, out.repeated);
  const FrameClock frames(generation == 2 ? log.frames : std::vector<LightFrame>());
  if (frames.empty()) {
    time_by_turns(generation, blocks, out);
  } else {
    time_by_frames(frames, blocks, out);
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
