// SPDX-License-Identifier: Apache-2.0
// The chip of firmware/rtl/soc, on a board whose constants.hpp is PHAROS_CHIP_CONSTANTS. Runs on the simulated chip
// (tests/rtl/chip); has not run on a board.
#include "firmware/hal/board.hpp"

#include "firmware/board/chip/addresses.hpp"
#include "firmware/board/chip/capture_block.hpp"
#include "firmware/board/rv32/common_system.hpp"
#include "firmware/board/rv32/processor.hpp"
#include "firmware/board/rv32/restart.hpp"
#include "firmware/board/rv32/trap.hpp"
#include "firmware/board/uart16550.hpp"
#include PHAROS_CHIP_CONSTANTS

namespace pharos::board {
namespace {

constexpr std::size_t kUartFifo = 128;
constexpr std::uint32_t kMillisecond = kClockHz / 1000;  // of the machine timer, which counts the core's clock
// Watchdog of one second: it is stopped until started, and writing its period restarts its time.
constexpr std::uintptr_t kWatchdogControl = kWatchdog + 4;
constexpr std::uintptr_t kWatchdogPeriod = kWatchdog + 8;
constexpr std::uint32_t kWatchdogStart = 4;
constexpr std::uintptr_t kTimerCompare = kTimer + 8;

CaptureBlock capture(kCapture);

class Line final : public hal::SerialLine {
 public:
  void start() { uart_.start(kUartDivisor); }
  std::size_t write(std::span<const std::uint8_t> bytes) override { return uart_.write(bytes); }
  bool idle() override { return uart_.idle(); }
  std::optional<std::uint8_t> read() override { return uart_.read(); }
  std::uint32_t receive_errors() override { return uart_.receive_errors(); }

 private:
  Uart16550 uart_{kUart, 4, kUartFifo};
};
Line line;

class System final : public CommonSystem {
 public:
  std::uint32_t cycles() override { return mmio32(kTimer); }
  std::uint32_t clock_hz() override { return kClockHz; }
  void feed_watchdog() override { mmio32(kWatchdogPeriod) = 0; }
  std::string_view board_name() override { return kNameOfBoard.data(); }
};
System system;

void (*millisecond_handler)(void*) = nullptr;
void* millisecond_context = nullptr;

void set_timer_in(std::uint32_t ticks) {
  const std::uint32_t high = mmio32(kTimer + 4);
  const std::uint32_t now = mmio32(kTimer);
  const std::uint32_t carry = mmio32(kTimer + 4) - high;  // it passed a low word of 0 in between
  const std::uint64_t next = (std::uint64_t{high + carry} << 32 | now) + ticks;
  mmio32(kTimerCompare + 4) = UINT32_MAX;
  mmio32(kTimerCompare) = static_cast<std::uint32_t>(next);
  mmio32(kTimerCompare + 4) = static_cast<std::uint32_t>(next >> 32);
}

}  // namespace

/// No device can pull the reset line on demand, so the watchdog does: it is no longer triggered.
void reset_machine() {
  disable_interrupts();
  mmio32(kWatchdogControl) = kWatchdogStart;
  for (;;) asm volatile("");
}

void on_timer_interrupt() {
  set_timer_in(kMillisecond);
  if (millisecond_handler != nullptr) millisecond_handler(millisecond_context);
}

}  // namespace pharos::board

namespace pharos::hal {

using namespace board;

Board start_board() {
  line.start();
  mmio32(kWatchdogControl) = kWatchdogStart;
  // Another block than this image was built for: its edges would be meaningless.
  if (!capture.start()) on_fault({.cause = 0, .address = kCapture, .value = mmio32(kCapture)});
  return {capture, line, board::system};
}

void wait_for_event() {}

void call_every_millisecond(void (*handler)(void*), void* context) {
  millisecond_context = context;
  millisecond_handler = handler;
  set_timer_in(kMillisecond);
  enable_timer_interrupt();
  enable_interrupts();
}

NoInterrupts::NoInterrupts() { disable_interrupts(); }
NoInterrupts::~NoInterrupts() { enable_interrupts(); }

}  // namespace pharos::hal
