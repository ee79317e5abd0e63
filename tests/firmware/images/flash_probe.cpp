// SPDX-License-Identifier: Apache-2.0
// A program to be flashed: sends Hello with its version, starts the loader on command, and contains words that it
// checks before it sends anything, so that a mixture of two images would send nothing.
#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/board/qemu_virt/machine.hpp"
#include "firmware/board/rv32/restart.hpp"
#include "firmware/board/uart16550.hpp"
#include "pharos/wire/codec.hpp"
#include "pharos/wire/command_message.hpp"
#include "pharos/wire/frame_decoder.hpp"
#include "pharos/wire/frame_encoder.hpp"
#include "pharos/wire/hello_message.hpp"

namespace {

using namespace pharos;

constexpr std::size_t kWords = PHAROS_PROBE_WORDS;

constexpr std::uint32_t next_word(std::uint32_t word) { return word * 1664525 + 1013904223; }

constexpr std::array<std::uint32_t, kWords> make_words() {
  std::array<std::uint32_t, kWords> words{};
  std::uint32_t word = PHAROS_PROBE_PATCH;
  for (std::uint32_t& w : words) w = word = next_word(word);
  return words;
}

constexpr std::array<std::uint32_t, kWords> kMade = make_words();

bool is_whole() {
  // volatile: read from memory, not from the compiler's constants.
  const volatile std::uint32_t* words = kMade.data();
  std::uint32_t word = PHAROS_PROBE_PATCH;
  for (std::size_t i = 0; i < kWords; ++i) {
    word = next_word(word);
    if (words[i] != word) return false;
  }
  return true;
}

board::Uart16550 uart(0x10000000, 1, 16);
wire::FrameEncoder encoder;

template <class M>
void say(const M& message) {
  std::array<std::uint8_t, M::kMaxBytes> payload{};
  std::array<std::uint8_t, wire::line_size(M::kMaxBytes)> line{};
  const std::size_t size = wire::encode_payload(message, payload);
  std::span<const std::uint8_t> left =
      std::span(line).first(encoder.encode(M::kType, std::span(payload).first(size), line));
  while (!left.empty()) left = left.subspan(uart.write(left));
}

void send_hello() {
  wire::Hello hello;
  hello.reset_cause = boot::last_reset(board::retained());
  hello.start_count = static_cast<std::uint16_t>(board::retained().start_count);
  hello.firmware_major = 1;
  hello.firmware_patch = PHAROS_PROBE_PATCH;
  hello.tick_rate_hz = 50'000'000;
  hello.time_ticks = board::machine_ticks();
  hello.board = wire::Text<24>("qemu_virt");
  say(hello);
}

void execute(const wire::Frame& frame) {
  const auto type = static_cast<std::uint8_t>(frame.type);
  const auto command = wire::decode_payload<wire::Command>(frame.payload);
  if (frame.type != wire::MessageType::kCommand || !command) {
    say(wire::Nak{type, frame.sequence, wire::NakReason::kUnsupported, 0});
    return;
  }
  say(wire::Ack{type, frame.sequence, 0});
  if (command->code == wire::CommandCode::kIdentify) send_hello();
  if (command->code == wire::CommandCode::kEnterLoader) {
    while (!uart.idle()) {
    }
    boot::announce_reset(board::retained(), wire::ResetCause::kCommand, true);
    board::reset_machine();
  }
}

}  // namespace

int main() {
#ifdef PHAROS_PROBE_SILENT
  board::reset_machine();  // without notice: as a reset by the watchdog
#endif
  uart.start(0);
  if (!is_whole()) return 1;
  wire::FrameDecoder frames;
  std::int64_t next_hello = board::machine_ticks();
  for (;;) {
    if (board::machine_ticks() >= next_hello) {
      next_hello += 50'000'000;
      send_hello();
      boot::confirm_start(board::retained());
    }
    while (const auto byte = uart.read()) {
      if (const auto frame = frames.push(*byte)) execute(*frame);
    }
  }
}
