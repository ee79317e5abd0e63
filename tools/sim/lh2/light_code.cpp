// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/lh2/light_code.hpp"

#include <algorithm>
#include <cmath>

namespace pharos::sim {
namespace {

struct Row {
  int thousands;  // of ticks of 48 MHz
  std::uint32_t taps[2];
};

constexpr Row kChannels[16] = {
    {959, {0x1D258, 0x17E04}}, {957, {0x1FF6B, 0x13F67}}, {953, {0x1B9EE, 0x198D1}}, {949, {0x178C7, 0x18A55}},
    {947, {0x15777, 0x1D911}}, {943, {0x15769, 0x1991F}}, {941, {0x12BD0, 0x1CF73}}, {939, {0x1365D, 0x197F5}},
    {937, {0x194A0, 0x1B279}}, {929, {0x13A34, 0x1AE41}}, {919, {0x180D4, 0x17891}}, {911, {0x12E64, 0x17C72}},
    {907, {0x19C6D, 0x13F32}}, {901, {0x1AE14, 0x14E76}}, {893, {0x13C97, 0x130CB}}, {887, {0x13750, 0x1CB8D}}};

}  // namespace

ChannelCode channel_code(std::size_t channel) {
  const Row& row = kChannels[channel % 16];
  return {row.thousands * 1000.0, {row.taps[0], row.taps[1]}};
}

std::vector<bool> light_bits(std::uint32_t taps, std::size_t count) {
  // Sixteen zeros and a one, then each bit the parity of those of the seventeen before it that have a tap.
  std::vector<bool> bits(16, false);
  bits.push_back(true);
  while (bits.size() < count) {
    bool odd = false;
    for (std::size_t back = 1; back <= 17; ++back) {
      if ((taps >> (back - 1) & 1U) != 0) odd = odd != bits[bits.size() - back];
    }
    bits.push_back(odd);
  }
  return bits;
}

std::vector<double> level_changes(const std::vector<bool>& bits, double from, double to) {
  std::vector<double> changes;
  const auto first = static_cast<std::size_t>(std::max(0.0, std::floor(from)));
  for (std::size_t i = first; i < bits.size() && static_cast<double>(i) < to; ++i) {
    const double begin = static_cast<double>(i);
    if (begin >= from) changes.push_back(begin);
    if (bits[i] && begin + 0.5 >= from && begin + 0.5 < to) changes.push_back(begin + 0.5);
  }
  return changes;
}

}  // namespace pharos::sim
