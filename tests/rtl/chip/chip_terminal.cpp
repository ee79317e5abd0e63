// SPDX-License-Identifier: Apache-2.0
// The simulated chip with its serial line on a pseudo-terminal, for `pharos flash` and pharosd.
//
// The simulation is some ten times slower than the chip. `pharos flash` waits for answers: it is run in the chip's time
// (chip_clock_preload.cpp). pharosd only reads, and relates the chip's clock to its own: what the chip sends under
// light is simulated first and then played to it at the chip's own pace.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <thread>

#include "pharos/base/ticks.hpp"
#include "pharos/wire/codec.hpp"
#include "pharos/wire/frame_decoder.hpp"
#include "pharos/wire/hello_message.hpp"
#include "rtl/chip/chip_bench.hpp"
#include "rtl/chip/chip_clock.hpp"
#include "rtl/chip/chip_files.hpp"
#include "rtl/chip/chip_kinds.hpp"
#include "rtl/chip/chip_light.hpp"
#include "tools/sim/pseudo_terminal.hpp"

namespace pharos::rtl {
namespace {

using Clock = std::chrono::steady_clock;
using Bytes = std::vector<std::uint8_t>;
constexpr std::int64_t kStep_ticks = 500;  // 10 us, half a byte of the line

/// Bytes from the chip and when it had sent them.
struct Sent {
  std::int64_t ticks;
  Bytes bytes;
};

/// Whether a program, not the loader, has said Hello.
class ProgramHello {
 public:
  bool seen(std::span<const std::uint8_t> bytes) {
    for (const std::uint8_t byte : bytes) {
      const auto frame = decoder_.push(byte);
      if (!frame || frame->type != wire::MessageType::kHello) continue;
      const auto hello = wire::decode_payload<wire::Hello>(frame->payload);
      seen_ = seen_ || (hello && hello->role != wire::Role::kLoader);
    }
    return seen_;
  }

 private:
  wire::FrameDecoder decoder_;
  bool seen_ = false;
};

bool waited_for(const std::function<bool()>& condition, double limit_s) {
  const auto end = Clock::now() + std::chrono::duration<double>(limit_s);
  while (!condition()) {
    if (Clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

void write_all(sim::PseudoTerminal& terminal, std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const std::size_t written = terminal.write(bytes);
    bytes = bytes.subspan(written);
    if (written == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

/// The chip and the terminal joined until a program runs and whoever wrote it has closed the port; false when the
/// chip's time is over.
bool run_until_flashed(ChipBench& bench, sim::PseudoTerminal& terminal, std::atomic<std::int64_t>& clock_ns,
                       double limit_s) {
  ProgramHello program;
  const double tick_hz = bench.device().tick_hz();
  for (std::int64_t ticks = 0; static_cast<double>(ticks) < limit_s * tick_hz; ticks += kStep_ticks) {
    bench.line().send(terminal.read());
    bench.run(kStep_ticks);
    clock_ns = static_cast<std::int64_t>(static_cast<double>(ticks) * 1e9 / tick_hz);
    const Bytes received = bench.take_received();
    write_all(terminal, received);
    if (program.seen(received) && !terminal.opened()) return true;
  }
  return false;
}

std::vector<Sent> sent_under_light(ChipBench& bench, std::int64_t end_ticks) {
  std::vector<Sent> sent;
  while (bench.device().ticks() < end_ticks) {
    bench.run_until(std::min(end_ticks, bench.device().ticks() + kStep_ticks));
    if (Bytes received = bench.take_received(); !received.empty()) {
      sent.push_back({bench.device().ticks(), std::move(received)});
    }
  }
  return sent;
}

void play(const std::vector<Sent>& sent, sim::PseudoTerminal& terminal) {
  const auto begin = Clock::now();
  for (const Sent& one : sent) {
    std::this_thread::sleep_until(begin + std::chrono::nanoseconds(ticks_to_nanoseconds(one.ticks - sent[0].ticks)));
    write_all(terminal, one.bytes);
  }
}

struct Arguments {
  std::string edges;
  std::string loader;
  std::string verifier;
  std::string link;
  std::string clock;
  std::string moved;
  std::string chip = kChips.front().name;
  double seconds = 1e9;
  double wait_s = 60.0;
};

int run(const Arguments& arguments) {
  constexpr double kFlashing_s = 30.0;  // of the chip
  constexpr std::int64_t kLead_ticks = kTicksPerSecond / 100;
  constexpr std::int64_t kTail_ticks = 6 * kTicksPerSecond / 100;
  const ChipKind& chip = chip_named(arguments.chip);
  ChipLight light = read_light(arguments.edges, arguments.seconds);
  ChipBench bench(chip.make());
  bench.device().set_rom(bytes_of(arguments.loader));
  std::ranges::copy(bytes_of(arguments.verifier), bench.flash().content().begin() + chip.verifier);
  bench.device().set_ticks(0);
  bench.power_on();
  auto* const clock_ns = map_chip_clock(arguments.clock.c_str());
  if (clock_ns == nullptr) throw host::InputError(arguments.clock + ": cannot be written");
  sim::PseudoTerminal terminal(arguments.link);
  std::fprintf(stderr, "waiting for an image on %s\n", terminal.path().c_str());
  if (!waited_for([&] { return terminal.opened(); }, arguments.wait_s)) {
    std::fprintf(stderr, "FAILED: nobody opened the port\n");
    return 1;
  }
  const auto begin = Clock::now();
  if (!run_until_flashed(bench, terminal, *clock_ns, kFlashing_s)) {
    std::fprintf(stderr, "FAILED: no program runs after %.0f s of the chip's time\n", kFlashing_s);
    return 1;
  }
  light.move(bench.device().ticks() + kLead_ticks - light.first_ticks);
  write_pulses(arguments.moved, light.pulses);
  bench.set_light(light.pulses);
  const std::vector<Sent> sent = sent_under_light(bench, light.last_ticks + kTail_ticks);
  std::fprintf(stderr, "%.1f s after the port was opened: waiting for a reader on %s\n",
               std::chrono::duration<double>(Clock::now() - begin).count(), terminal.path().c_str());
  if (!waited_for([&] { return terminal.opened(); }, arguments.wait_s)) {
    std::fprintf(stderr, "FAILED: nobody opened the port again\n");
    return 1;
  }
  play(sent, terminal);
  std::fprintf(stderr, "played\n");
  (void)waited_for([&] { return !terminal.opened(); }, arguments.wait_s);
  return 0;
}

}  // namespace
}  // namespace pharos::rtl

int main(int count, char** values) {
  pharos::rtl::Arguments arguments;
  CLI::App app{
      "The simulated chip, its flash empty, with its serial line on a pseudo-terminal: takes an image of `pharos "
      "flash`,\n"
      "starts it, then EDGES are on its photodiodes' pins; what it sends under them goes to who opens the port next, "
      "at\n"
      "the chip's own pace.\n"
      "Example: chip_terminal slice.csv --loader ep4ce10_loader.bin --verifier verifier.bin --link port --clock clock "
      "--moved light.csv"};
  app.add_option("EDGES", arguments.edges, "table sensor,rise_ticks,fall_ticks")->required();
  app.add_option("--loader", arguments.loader, "bytes of the boot ROM")->required();
  app.add_option("--verifier", arguments.verifier, "the verifier in flash")->required();
  app.add_option("--link", arguments.link, "name for the port")->required();
  app.add_option("--clock", arguments.clock, "file for the chip's time, see chip_clock_preload.cpp")->required();
  app.add_option("--moved", arguments.moved, "file for EDGES as the chip sees them, later")->required();
  app.add_option("--chip", arguments.chip, "ep4ce10 or up5k")->check(CLI::IsMember({"ep4ce10", "up5k"}));
  app.add_option("--seconds", arguments.seconds, "seconds of light to simulate");
  app.add_option("--wait", arguments.wait_s, "seconds to wait for who opens the port");
  CLI11_PARSE(app, count, values);
  try {
    return pharos::rtl::run(arguments);
  } catch (const pharos::host::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
