// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <random>

#include "rtl/capture_rig.hpp"

namespace pharos::rtl {

/// Drives pins and bus at random, in phases of different kinds: no edges, single edges, flashes on all inputs, one-tick
/// pulses, every input random in every tick; a reader that is absent, reads any address, or drains the FIFO. Registers
/// are written in between. The rig compares every tick.
class RandomTraffic {
 public:
  RandomTraffic(CaptureRig& rig, std::uint64_t seed) : rig_(rig), random_(seed) {}

  /// Runs for `ticks` or until the rig reports a difference.
  void run(std::uint64_t ticks);

 private:
  enum class Light { kDark, kSparse, kFlashes, kOneTickPulses, kEveryTick, kStorm, kCount };
  enum class Reader { kAbsent, kAnything, kDrains, kDrainsSlowly, kCount };

  std::uint32_t below(std::uint32_t bound) { return static_cast<std::uint32_t>(random_() % bound); }
  std::uint32_t next_pins();
  BusRequest next_request();
  BusRequest random_write();

  CaptureRig& rig_;
  std::mt19937_64 random_;
  Light light_ = Light::kDark;
  Reader reader_ = Reader::kAbsent;
  std::uint32_t words_left_ = 0;  // of the record being read
};

}  // namespace pharos::rtl
