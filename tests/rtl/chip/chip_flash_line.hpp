// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "rtl/chip/chip_bench.hpp"
#include "tools/flash/flash_session.hpp"

namespace pharos::rtl {

/// The chip's serial line, in the chip's time; and the longest time that the chip took for an answer.
class ChipFlashLine final : public tools::FlashLine {
 public:
  explicit ChipFlashLine(ChipBench& bench) : bench_(bench) {}

  void write(std::span<const std::uint8_t> bytes) override {
    bench_.line().send(bytes);
    while (!bench_.line().sent()) run();
    asked_ = true;
    (void)bench_.take_counts();
  }
  std::size_t read(std::span<std::uint8_t> out, std::int64_t deadline_ns) override {
    while (waiting_.empty() && now_ns() < deadline_ns) run();
    const std::size_t count = std::min(out.size(), waiting_.size());
    std::copy_n(waiting_.begin(), count, out.begin());
    waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(count));
    return count;
  }
  std::int64_t now_ns() override {
    return static_cast<std::int64_t>(static_cast<double>(now_ticks_) * 1e9 / bench_.device().tick_hz());
  }

  std::int64_t now_ticks() const { return now_ticks_; }
  /// Called with the time and the ticks that are to be run; returns how many of them.
  std::function<std::int64_t(std::int64_t, std::int64_t)> before_step;
  /// Between the last bit of a request and the end of the first byte of what came next.
  ChipCounts longest_answer;

 private:
  void run() {
    constexpr std::int64_t kStep_ticks = 50;
    const std::int64_t step = before_step ? before_step(now_ticks_, kStep_ticks) : kStep_ticks;
    bench_.run(step);
    now_ticks_ += step;
    const auto received = bench_.take_received();
    waiting_.insert(waiting_.end(), received.begin(), received.end());
    if (received.empty() || !asked_) return;
    asked_ = false;
    const ChipCounts counts = bench_.take_counts();
    if (counts.ticks > longest_answer.ticks) longest_answer = counts;
  }

  ChipBench& bench_;
  std::vector<std::uint8_t> waiting_;
  std::int64_t now_ticks_ = 0;
  bool asked_ = false;  // nothing came since
};

}  // namespace pharos::rtl
