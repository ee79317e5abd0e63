// SPDX-License-Identifier: Apache-2.0
#include "firmware/hal/board.hpp"

#include <algorithm>

#include "firmware/board/qemu_virt/capture_replay.hpp"
#include "firmware/board/qemu_virt/machine.hpp"
#include "firmware/board/rv32/common_system.hpp"
#include "firmware/board/rv32/processor.hpp"
#include "firmware/board/rv32/restart.hpp"
#include "firmware/board/rv32/trap.hpp"
#include "firmware/board/uart16550.hpp"
#include "pharos/base/ticks.hpp"

namespace pharos::board {
namespace {

constexpr std::uintptr_t kUart = 0x10000000;
constexpr std::size_t kUartFifo = 16;
/// QEMU's UART accepts bytes at any speed. This is the rate of a line of 460,800 baud, in the tape's time; like the
/// board's UART it holds 128 bytes.
constexpr std::int64_t kByte_ticks = 10 * kTicksPerSecond / 460'800;
constexpr std::int64_t kLineHolds = 128;
constexpr std::int64_t kMillisecond = kTicksPerSecond / 1000;
/// The watchdog, which the machine does not have: this many timer interrupts without a trigger between them. Longer
/// than the board's, because a busy computer may stop the emulator for a second.
constexpr std::int64_t kWatchdogPoll_ticks = kTicksPerSecond / 10;
constexpr int kWatchdogPolls = 100;
/// Of the machine's time, where the emulator counts instructions (-icount shift=0).
constexpr std::int64_t kInstruction_ns = 1;
/// Instructions a second of the chip's core (firmware/rtl/soc), where the tape names no other: 50 MHz at the 1.67
/// cycles an instruction that `decoder` was measured to take there.
constexpr std::uint32_t kInstructionsPerSecond = 30'000'000;

CaptureReplay tape;

// Instructions except those that a board does not execute.
std::uint32_t core_instructions() { return instructions_retired_low() - tape.instructions(); }

class Line final : public hal::SerialLine {
 public:
  void start() { uart_.start(0); }
  std::size_t write(std::span<const std::uint8_t> bytes) override {
    const std::int64_t room = room_for();
    if (room <= 0 && !tape.ended()) return 0;
    const auto maximum = tape.ended() ? bytes.size() : static_cast<std::size_t>(room);  // at the end nothing is cut off
    // QEMU's UART holds 16 bytes and takes the next at once.
    std::size_t taken = 0;
    for (std::size_t more = 1; more != 0 && taken < std::min(bytes.size(), maximum); taken += more) {
      more = uart_.write(bytes.subspan(taken, std::min(bytes.size(), maximum) - taken));
    }
    busy_until_ += static_cast<std::int64_t>(taken) * kByte_ticks;
    wrote_ = wrote_ || taken != 0;
    return taken;
  }
  bool idle() override { return uart_.idle(); }
  // Once a millisecond of the tape: a poll costs the emulator more than a record does.
  std::optional<std::uint8_t> read() override {
    if (!more_ && tape.now_ticks() - looked_ticks_ < kMillisecond && !tape.waiting()) return std::nullopt;
    looked_ticks_ = tape.now_ticks();
    const auto byte = uart_.read();
    more_ = byte.has_value();
    return byte;
  }
  std::uint32_t receive_errors() override { return uart_.receive_errors(); }
  /// Whether anything was written since the last call.
  bool take_wrote() {
    const bool wrote = wrote_;
    wrote_ = false;
    return wrote;
  }

 private:
  std::int64_t room_for() {
    const std::int64_t now = tape.now_ticks();
    const CaptureReplay::PausedClock aside(tape);
    if (busy_until_ < now) busy_until_ = now;
    return kLineHolds - (busy_until_ - now + kByte_ticks - 1) / kByte_ticks;
  }

  Uart16550 uart_{kUart, 1, kUartFifo};
  std::int64_t busy_until_ = 0;
  std::int64_t looked_ticks_ = 0;
  bool more_ = false;
  bool wrote_ = false;
};
Line line;

// The machine timer serves the watchdog and the call every millisecond.
volatile bool fed = false;
int unfed_polls = 0;
std::int64_t next_watchdog_poll = 0;
void (*millisecond_handler)(void*) = nullptr;
void* millisecond_context = nullptr;

void poll_watchdog(std::int64_t now) {
  if (now < next_watchdog_poll) return;
  next_watchdog_poll = now + kWatchdogPoll_ticks;
  unfed_polls = fed ? 0 : unfed_polls + 1;
  fed = false;
  if (unfed_polls < kWatchdogPolls) return;
  boot::announce_reset(retained(), wire::ResetCause::kWatchdog);
  reset_machine();
}

class System final : public CommonSystem {
 public:
  std::uint32_t cycles() override { return core_instructions(); }
  std::uint32_t clock_hz() override {
    const std::uint32_t paced = tape.instructions_a_millisecond() * 1000;
    return paced != 0 ? paced : kInstructionsPerSecond;
  }
  void feed_watchdog() override { fed = true; }
  std::string_view board_name() override { return "qemu_virt"; }
};
System system;

/// After the tape's end, in a row: the interrupt that writes may not have occurred between two of them.
constexpr int kQuietRests = 4;
int quiet_rests = 0;

/// The loader stores why the machine was reset; an image started without one has no cause.
void note_reset_without_loader() {
  volatile boot::Retained& kept = retained();
  if (kept.mark != boot::Retained::kMark || kept.announced != 0) boot::note_reset(kept);
}

}  // namespace

void on_timer_interrupt() {
  const std::int64_t now = machine_ticks();
  poll_watchdog(now);
  if (millisecond_handler == nullptr) {
    set_timer(next_watchdog_poll);
    return;
  }
  const std::uint32_t begin = core_instructions();
  millisecond_handler(millisecond_context);
  const CaptureReplay::PausedClock aside(tape);
  if (tape.instructions_a_millisecond() == 0) {
    set_timer(now + kMillisecond);
  } else {
    // A core of the tape's speed is called by its own time, in which reading the tape takes none.
    const std::int64_t left = std::int64_t{tape.instructions_a_millisecond()} - (core_instructions() - begin);
    set_timer(machine_ticks() + std::max<std::int64_t>(left, 1) * kInstruction_ns / kNanosecondsPerTick);
  }
}

}  // namespace pharos::board

namespace pharos::hal {

using namespace board;

Board start_board() {
  note_reset_without_loader();
  line.start();
  enable_timer_interrupt();
  tape.start();
  next_watchdog_poll = machine_ticks() + kWatchdogPoll_ticks;
  set_timer(next_watchdog_poll);
  enable_interrupts();
  return {tape, line, board::system};
}

void wait_for_event() {
  if (tape.ended()) {
    quiet_rests = line.take_wrote() ? 0 : quiet_rests + 1;
    if (quiet_rests == kQuietRests) exit_emulator(0);
  } else if (tape.instructions_a_millisecond() != 0) {
    return;  // the core's time does not advance while it sleeps
  }
  const bool interrupt_reads = millisecond_handler != nullptr;
  // A read of the clock is no record, but more may follow at once.
  if (!interrupt_reads && (tape.ended() || !tape.waiting())) return;
  if (!interrupt_reads) set_timer(machine_ticks() + kMillisecond);
  wait_for_interrupt();
}

void call_every_millisecond(void (*handler)(void*), void* context) {
  const NoInterrupts guard;
  millisecond_context = context;
  millisecond_handler = handler;
  set_timer(machine_ticks() + kMillisecond);
}

NoInterrupts::NoInterrupts() { disable_interrupts(); }
NoInterrupts::~NoInterrupts() { enable_interrupts(); }

}  // namespace pharos::hal
