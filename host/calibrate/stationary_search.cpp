// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/stationary_search.hpp"

#include <array>
#include <bitset>
#include <cmath>

#include "pharos/base/ticks.hpp"
#include "pharos/base/units.hpp"

namespace pharos::calibrate {
namespace {

constexpr std::int64_t kBlock_ticks = kTicksPerSecond / 10;
constexpr std::size_t kTrimmedBlocks = 1;  // at each end
constexpr std::size_t kFewestBlocks = 5;   // the remaining blocks must last half a second
constexpr double kNoisiestSweep_rad = 11.0 * kRadPerArcsec;
constexpr double kGate = 5.0;
constexpr int kFewestChannels = 6;
constexpr std::size_t kChannels = kMaxStations * kAxes * kMaxSensors;

struct Mean {
  double sum = 0.0;
  int count = 0;
};
using Channels = std::array<Mean, kChannels>;

std::size_t channel_of(const LoggedSweep& sweep, std::uint8_t sensor) {
  return (static_cast<std::size_t>(sweep.slot) * kAxes + static_cast<std::size_t>(index_of(sweep.axis))) * kMaxSensors +
         sensor;
}

// Only sensors hit once in the sweep: of several hits it is not yet known which one is direct.
void add(const LoggedSweep& sweep, Channels& channels) {
  std::bitset<kMaxSensors> seen;
  std::bitset<kMaxSensors> twice;
  for (const LoggedHit& hit : sweep.hits) {
    if (seen[hit.sensor]) twice.set(hit.sensor);
    seen.set(hit.sensor);
  }
  for (const LoggedHit& hit : sweep.hits) {
    if (twice[hit.sensor]) continue;
    Mean& mean = channels[channel_of(sweep, hit.sensor)];
    mean.sum += hit.raw_rad;
    ++mean.count;
  }
}

void add(const Channels& from, Channels& to) {
  for (std::size_t i = 0; i < kChannels; ++i) {
    to[i].sum += from[i].sum;
    to[i].count += from[i].count;
  }
}

bool agree(const Channels& a, const Channels& b) {
  int common = 0;
  int agreeing = 0;
  for (std::size_t i = 0; i < kChannels; ++i) {
    if (a[i].count < 2 || b[i].count < 2) continue;
    ++common;
    const double difference = a[i].sum / a[i].count - b[i].sum / b[i].count;
    const double sigma = kNoisiestSweep_rad * std::sqrt(1.0 / a[i].count + 1.0 / b[i].count);
    if (std::abs(difference) < kGate * sigma) ++agreeing;
  }
  return common >= kFewestChannels && 5 * agreeing >= 4 * common;
}

struct Block {
  std::int64_t from_ticks = 0;
  Channels channels{};
};

class Search {
 public:
  void push(const LoggedSweep& sweep) {
    if (!blocks_.empty() && sweep.flash_ticks < blocks_.back().from_ticks + kBlock_ticks) {
      add(sweep, blocks_.back().channels);
      return;
    }
    const bool gap = !blocks_.empty() && sweep.flash_ticks >= blocks_.back().from_ticks + 2 * kBlock_ticks;
    take_last_block();
    if (gap) end_interval();
    const bool follows = !blocks_.empty() && !gap;
    blocks_.push_back({follows ? blocks_.back().from_ticks + kBlock_ticks : sweep.flash_ticks, {}});
    add(sweep, blocks_.back().channels);
  }

  StationarySearch finish() {
    take_last_block();
    end_interval();
    return found_;
  }

 private:
  // The newest block is complete: it continues the interval, or ends it and begins another.
  void take_last_block() {
    if (blocks_.empty()) return;
    if (blocks_.size() == 1 || agree(blocks_.back().channels, rest_)) {
      add(blocks_.back().channels, rest_);
      return;
    }
    const Block next = blocks_.back();
    blocks_.pop_back();
    end_interval();
    blocks_.push_back(next);
    rest_ = next.channels;
  }

  void end_interval() {
    keep();
    blocks_.clear();
    rest_ = {};
  }

  void keep() {
    if (blocks_.size() < 2) return;  // in motion
    if (blocks_.size() < kFewestBlocks + 2 * kTrimmedBlocks) {
      ++found_.too_short;
      return;
    }
    const std::size_t first = kTrimmedBlocks;
    const std::size_t end = blocks_.size() - kTrimmedBlocks;
    const std::size_t third = std::max<std::size_t>((end - first) / 3, 1);
    if (!agree(sum(first, first + third), sum(end - third, end))) {
      ++found_.drifting;
      return;
    }
    found_.intervals.push_back({blocks_[first].from_ticks, blocks_[end - 1].from_ticks + kBlock_ticks});
  }

  Channels sum(std::size_t from, std::size_t to) const {
    Channels channels{};
    for (std::size_t i = from; i < to; ++i) add(blocks_[i].channels, channels);
    return channels;
  }

  std::vector<Block> blocks_;  // of the present interval; the last one is incomplete
  Channels rest_{};
  StationarySearch found_;
};

}  // namespace

StationarySearch find_stationary_intervals(std::span<const LoggedSweep> sweeps) {
  Search search;
  for (const LoggedSweep& sweep : sweeps) search.push(sweep);
  return search.finish();
}

}  // namespace pharos::calibrate
