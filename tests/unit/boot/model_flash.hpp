// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <random>
#include <set>
#include <span>
#include <stdexcept>
#include <vector>

#include "firmware/hal/flash.hpp"

namespace pharos::boot::test {

/// Thrown by a write when power is lost.
struct PowerCut {};

/// NOR flash that can lose power at every single step: programming is a step a byte, erasing three a sector. A byte
/// that was being programmed keeps some of its ones; a sector that was being erased has random content; and both may be
/// read differently each time until they are erased again.
class ModelFlash {
 public:
  static constexpr std::uint32_t kSectorBytes = 64 * 1024;
  static constexpr std::uint32_t kBytes = 7 * kSectorBytes;

  std::vector<std::uint8_t> bytes = std::vector<std::uint8_t>(kBytes, 0xFF);
  /// Steps until power is lost.
  std::uint64_t steps_left = UINT64_MAX;
  std::uint64_t steps_done = 0;
  std::mt19937 random;
  /// Called during an operation, with a part of its duration in ticks.
  std::function<void(std::int64_t)> elapse = [](std::int64_t) {};
  std::int64_t program_ticks = 0;  // a page
  std::int64_t erase_ticks = 0;    // a sector
  /// The next writes fail and report it.
  bool broken = false;

  void read(std::uint32_t offset, std::span<std::uint8_t> out) {
    for (std::size_t i = 0; i < out.size(); ++i) {
      const std::uint32_t at = offset + static_cast<std::uint32_t>(i);
      out[i] = bytes.at(at);
      if (unstable_.contains(at)) out[i] ^= static_cast<std::uint8_t>(random());
    }
  }

  template <class Idle>
  bool program(std::uint32_t offset, std::span<const std::uint8_t> in, Idle&& idle) {
    if (offset % 4 != 0 || in.size() % 4 != 0) throw std::logic_error("program: not whole words");
    if (offset / hal::kFlashPageBytes != (offset + in.size() - 1) / hal::kFlashPageBytes) {
      throw std::logic_error("program: across pages");
    }
    work(program_ticks, idle);
    if (broken) return false;
    for (const std::uint8_t byte : in) {
      if (step()) {
        bytes.at(offset) = static_cast<std::uint8_t>(bytes.at(offset) & (byte | random()));
        unstable_.insert(offset);
        throw PowerCut{};
      }
      bytes.at(offset) = static_cast<std::uint8_t>(bytes.at(offset) & byte);
      ++offset;
    }
    return true;
  }

  template <class Idle>
  bool erase_sector(std::uint32_t offset, Idle&& idle) {
    if (offset % kSectorBytes != 0) throw std::logic_error("erase: not the start of a sector");
    if (broken) return false;
    if (step()) throw PowerCut{};
    work(erase_ticks, idle);
    if (step()) {
      for (std::uint32_t at = offset; at < offset + kSectorBytes; ++at) leave_anything(at);
      throw PowerCut{};
    }
    for (std::uint32_t at = offset; at < offset + kSectorBytes; ++at) {
      bytes[at] = 0xFF;
      unstable_.erase(at);
    }
    if (step()) throw PowerCut{};
    return true;
  }

 private:
  bool step() {
    ++steps_done;
    return steps_left-- == 0;
  }
  template <class Idle>
  void work(std::int64_t ticks, Idle& idle) {
    constexpr std::int64_t kPart = 500;  // 10 us
    for (; ticks > 0; ticks -= kPart) {
      elapse(kPart);
      idle();
    }
  }
  void leave_anything(std::uint32_t at) {
    const auto rng = static_cast<std::uint32_t>(random());
    switch (rng % 4) {
      case 0:
        return;  // unchanged
      case 1:
        bytes[at] = 0xFF;
        return;
      case 2:
        bytes[at] = static_cast<std::uint8_t>(rng >> 8);
        return;
      default:
        if (rng % 64 == 3) unstable_.insert(at);
    }
  }

  std::set<std::uint32_t> unstable_;
};

}  // namespace pharos::boot::test
