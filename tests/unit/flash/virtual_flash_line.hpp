// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "tools/flash/flash_line.hpp"
#include "unit/boot/virtual_target.hpp"

namespace pharos::tools::test {

inline constexpr std::int64_t kNsPerTick = 20;

/// The line between `pharos flash` and a virtual target, in virtual time: bytes have their transmission time, the
/// host's adapter delivers received bytes every few milliseconds, and a test can lose any byte.
class VirtualFlashLine final : public FlashLine {
 public:
  explicit VirtualFlashLine(boot::test::VirtualTarget& target) : target_(target) {}

  /// Delivery interval of the adapter; 0: at once.
  std::int64_t adapter_ticks = 0;
  /// The byte as received; empty: it is lost.
  using Fault = std::function<std::optional<std::uint8_t>(std::uint8_t)>;
  Fault to_target = [](std::uint8_t byte) { return byte; };
  Fault to_host = [](std::uint8_t byte) { return byte; };
  /// Called when time advances.
  std::function<void()> meanwhile = [] {};
  std::uint64_t bytes_written = 0;

  void write(std::span<const std::uint8_t> bytes) override {
    bytes_written += bytes.size();
    std::vector<std::uint8_t> arriving;
    for (const std::uint8_t byte : bytes) {
      if (const auto arrives = to_target(byte)) arriving.push_back(*arrives);
    }
    target_.machine.host_sends(arriving);
  }

  std::size_t read(std::span<std::uint8_t> out, std::int64_t deadline_ns) override {
    for (;;) {
      std::size_t count = 0;
      auto& coming = target_.machine.from_target;
      while (count < out.size() && !coming.empty() && coming.front().when <= handed_on_until()) {
        if (const auto arrives = to_host(coming.front().byte)) out[count++] = *arrives;
        coming.pop_front();
      }
      if (count > 0 || now_ns() >= deadline_ns) return count;
      target_.step();
      meanwhile();
    }
  }

  std::int64_t now_ns() override { return target_.machine.now * kNsPerTick; }

 private:
  std::int64_t handed_on_until() const {
    const std::int64_t now = target_.machine.now;
    return adapter_ticks == 0 ? now : now - now % adapter_ticks;
  }

  boot::test::VirtualTarget& target_;
};

}  // namespace pharos::tools::test
