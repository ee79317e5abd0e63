// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "firmware/boot/boot_board.hpp"
#include "pharos/base/ticks.hpp"
#include "pharos/signature/sha2.hpp"
#include "unit/boot/model_flash.hpp"

namespace pharos::boot::test {

/// Stands for a signature on the model board: SHA-512 of what is signed. The real verification runs under QEMU.
inline std::array<std::uint8_t, 64> model_signature(std::span<const std::uint8_t> message) {
  signature::Sha512 hash;
  hash.add(message);
  auto signature = hash.finish();
  signature.back() &= 0x1F;  // as in every signature
  return signature;
}

/// A board without its power supply: memory, flash, and a serial line with transmission times.
struct Machine {
  static constexpr std::uint32_t kMemoryAddress = 0x80800000;
  static constexpr std::size_t kMemoryBytes = 100 * 1024;

  ModelFlash flash;
  std::vector<std::uint8_t> memory = std::vector<std::uint8_t>(kMemoryBytes);
  Retained retained;
  bool development = false;  // the jumper
  bool has_verifier = true;
  std::int64_t now = 0;  // ticks
  std::int64_t byte_ticks = 10 * kTicksPerSecond / 460'800;
  /// Sizes of the UART's receive and transmit buffers, bytes.
  std::size_t uart_holds = 16;
  std::uint64_t overruns = 0;

  struct TimedByte {
    std::int64_t when;  // time of complete reception
    std::uint8_t byte;
  };
  std::deque<TimedByte> to_target;
  std::deque<TimedByte> from_target;

  Machine() {
    flash.elapse = [this](std::int64_t ticks) { now += ticks; };
  }
  Machine(const Machine&) = delete;
  Machine& operator=(const Machine&) = delete;

  void host_sends(std::span<const std::uint8_t> bytes) {
    for (const std::uint8_t byte : bytes) {
      into_target_ = std::max(into_target_, now) + byte_ticks;
      to_target.push_back({into_target_, byte});
    }
  }
  /// Until then the wire is busy with bytes from the host.
  std::int64_t host_busy_until() const { return into_target_; }

  int receive() {
    constexpr std::int64_t kPoll_ticks = 30;  // of a loop of as many instructions
    now += kPoll_ticks;
    const auto arrived = std::ranges::find_if(to_target, [this](const TimedByte& b) { return b.when > now; });
    const auto waiting = static_cast<std::size_t>(arrived - to_target.begin());
    if (waiting == 0) return -1;
    if (waiting > uart_holds) {
      overruns += waiting - uart_holds;
      to_target.erase(to_target.begin() + static_cast<std::ptrdiff_t>(uart_holds), arrived);
    }
    const std::uint8_t byte = to_target.front().byte;
    to_target.pop_front();
    return byte;
  }
  bool transmit(std::uint8_t byte) {
    if (out_of_target_ > now + static_cast<std::int64_t>(uart_holds) * byte_ticks) return false;
    out_of_target_ = std::max(out_of_target_, now) + byte_ticks;
    from_target.push_back({out_of_target_, byte});
    return true;
  }

 private:
  std::int64_t into_target_ = 0;
  std::int64_t out_of_target_ = 0;
};

/// The loader's board on `machine`, one at a time.
struct ModelBoard {
  inline static Machine* machine = nullptr;

  static constexpr std::array<char, 24> kName{"model"};
  using Flash = ModelFlash;
  static constexpr std::uint32_t kSlotBytes = 2 * ModelFlash::kSectorBytes;
  static constexpr std::uint32_t kFloorOffset = boot_image::kSlots * kSlotBytes;
  static_assert(kFloorOffset + ModelFlash::kSectorBytes == ModelFlash::kBytes);

  static void prepare() {}
  static Flash& flash() { return machine->flash; }
  static std::uint32_t slot_offset(std::size_t slot) { return static_cast<std::uint32_t>(slot) * kSlotBytes; }
  static int receive() { return machine->receive(); }
  static bool transmit(std::uint8_t byte) { return machine->transmit(byte); }
  static std::uint32_t ticks() { return static_cast<std::uint32_t>(machine->now); }
  static std::uint8_t* memory(std::uint32_t address, std::uint32_t bytes) {
    const std::uint32_t before = address - Machine::kMemoryAddress;
    const bool there = before <= Machine::kMemoryBytes && bytes <= Machine::kMemoryBytes - before;
    return there ? machine->memory.data() + before : nullptr;
  }
  static volatile Retained& retained() { return machine->retained; }
  static bool development() { return machine->development; }
  static Verdict verify(std::span<const std::uint8_t> message, const std::uint8_t* signature) {
    if (!machine->has_verifier) return Verdict::kNoVerifier;
    return std::ranges::equal(model_signature(message), std::span(signature, 64)) ? Verdict::kGood : Verdict::kBad;
  }
  static void start(std::uint32_t) {}
  static void restart() {}
};
static_assert(BootBoard<ModelBoard>);

}  // namespace pharos::boot::test
