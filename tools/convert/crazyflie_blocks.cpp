// SPDX-License-Identifier: Apache-2.0
#include "tools/convert/crazyflie_blocks.hpp"

#include <utility>

#include "pharos/base/units.hpp"

namespace pharos::convert {
namespace {

constexpr double kGroup_s = 0.003;  // angles of one group are logged within 0.4 ms; groups follow after 8 ms and more

bool begins_group(const LoggedAngle& before, const LoggedAngle& angle) {
  const auto key = [](const LoggedAngle& a) { return std::array{a.sensor, a.station, a.plane}; };
  return angle.time_s - before.time_s > kGroup_s || key(angle) <= key(before);
}

}  // namespace

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
      Block block{logged_s, angles, angles};
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

double turns_of(int generation, std::uint8_t plane, double angle_rad) {
  if (generation == 1) return 0.5 * plane + (angle_rad + kPi / 2) / kTwoPi;
  return (angle_rad + kPi + (plane == 0 ? -kPi / 3 : kPi / 3)) / kTwoPi;
}

}  // namespace pharos::convert
