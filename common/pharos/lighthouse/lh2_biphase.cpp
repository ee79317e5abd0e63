// SPDX-License-Identifier: Apache-2.0
#include "pharos/lighthouse/lh2_biphase.hpp"

#include "pharos/lighthouse/lh2_channels.hpp"

namespace pharos::lighthouse {
namespace {

constexpr int kRaster = kHalfBit_sixths;
// Jitter of a receiver's changes: 25 ns on either side (captures), 7 sixths.
constexpr int kReach = 7;
// Of 8 an edge: changes at random score 2.6, bursts of the captures 4.5 and more.
constexpr int kMinScorePerEdge = 3;
constexpr std::size_t kMinBits = 17;
constexpr std::size_t kCells = 2 * kMaxBurstBits + 2;

using Histogram = std::array<std::uint8_t, kRaster>;

int weight(int distance) { return kReach + 1 - (distance < 0 ? -distance : distance); }

/// -12..12: from `phase` to `value` around the raster.
int around(int value, int phase) {
  int d = (value - phase) % kRaster;
  if (d < 0) d += kRaster;
  return d > kRaster / 2 ? d - kRaster : d;
}

int score_of(const Histogram& histogram, int phase) {
  int score = 0;
  for (int d = -kReach; d <= kReach; ++d) {
    score += weight(d) * histogram[static_cast<std::size_t>((phase + d + kRaster) % kRaster)];
  }
  return score;
}

/// Phase of the half bits after the burst's start, sixths, 0..24; empty where there is none.
std::optional<int> phase_of(const Lh2Burst& burst) {
  Histogram histogram{};
  for (const std::uint16_t ticks : burst.edge_ticks) {
    ++histogram[static_cast<std::size_t>(ticks * kSixthsPerTick % kRaster)];
  }
  int best = 0, best_score = -1;
  for (int phase = 0; phase < kRaster; ++phase) {
    const int score = score_of(histogram, phase);
    if (score > best_score) best = phase, best_score = score;
  }
  if (best_score < kMinScorePerEdge * static_cast<int>(burst.edge_ticks.size())) return std::nullopt;
  // The mean of what lies near it.
  int sum = 0, count = 0;
  for (const std::uint16_t ticks : burst.edge_ticks) {
    const int d = around(ticks * kSixthsPerTick, best);
    if (d < -kReach || d > kReach) continue;
    sum += d;
    ++count;
  }
  const int mean = (2 * sum + (sum < 0 ? -count : count)) / (2 * count);
  return (best + mean + kRaster) % kRaster;
}

}  // namespace

std::optional<Lh2Bits> biphase_bits(const Lh2Burst& burst) {
  const std::optional<int> phase = phase_of(burst);
  if (!phase) return std::nullopt;
  // Cell c: changes around phase + 25 (c - 1), odd number of them: the level changed there.
  std::array<bool, kCells> changed{};
  std::size_t cells = 0;
  for (const std::uint16_t ticks : burst.edge_ticks) {
    const auto cell = static_cast<std::size_t>((ticks * kSixthsPerTick - *phase + kRaster + kRaster / 2) / kRaster);
    if (cell >= kCells) break;
    changed[cell] = !changed[cell];
    cells = cell + 1;
  }
  std::array<int, 2> changes{};
  for (std::size_t c = 0; c < cells; ++c) changes[c % 2] += changed[c] ? 1 : 0;
  std::size_t first = changes[1] > changes[0] ? 1 : 0;
  while (first + 2 < cells && !changed[first]) first += 2;

  Lh2Bits bits;
  bits.sensor = burst.sensor;
  const std::int64_t origin = burst.start_ticks * kSixthsPerTick;
  bits.start_sixths = origin + *phase + (static_cast<std::int64_t>(first) - 1) * kRaster;
  bits.light_begin_sixths = origin + std::int64_t{burst.light_begin_ticks} * kSixthsPerTick;
  bits.light_end_sixths = origin + std::int64_t{burst.light_end_ticks} * kSixthsPerTick;
  for (std::size_t c = first; c + 2 < kCells && c + 1 < cells && bits.count < kMaxBurstBits; c += 2, ++bits.count) {
    const std::size_t word = bits.count / 32U, place = bits.count % 32U;
    bits.values[word] |= std::uint32_t{changed[c + 1]} << place;
    bits.clean[word] |= std::uint32_t{changed[c] && changed[c + 2]} << place;
  }
  if (bits.count < kMinBits) return std::nullopt;
  return bits;
}

}  // namespace pharos::lighthouse
