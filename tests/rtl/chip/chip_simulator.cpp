// SPDX-License-Identifier: Apache-2.0
// The whole chip from light to the serial line, tick by tick.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>

#include "host/support/input_error.hpp"
#include "pharos/base/ticks.hpp"
#include "pharos/boot_image/slot.hpp"
#include "pharos/wire/codec.hpp"
#include "pharos/wire/counters_message.hpp"
#include "pharos/wire/frame_decoder.hpp"
#include "pharos/wire/sweep_message.hpp"
#include "rtl/chip/chip_bench.hpp"
#include "rtl/chip/chip_files.hpp"
#include "rtl/chip/chip_kinds.hpp"
#include "rtl/chip/chip_light.hpp"

namespace pharos::rtl {
namespace {

struct Arguments {
  std::string edges;
  std::string program;
  std::string external;
  std::string loader;
  std::string image;
  std::string flash;
  std::string output;
  std::string stamped;
  std::string chip = kChips.front().name;
  double seconds = 1e9;
  double count_from = 0.0;
};

/// The program must be ready before the first light; after the last, its frames are still to be sent.
constexpr std::int64_t kLead_ticks = 10 * kTicksPerSecond / 1000;
constexpr std::int64_t kLoaderLead_ticks = 4 * kTicksPerSecond / 10;  // waits 0.2 s for a host
constexpr std::int64_t kLoaderLeadOfByte_ticks = 400;                 // copies and hashes the image
constexpr std::int64_t kSlotBytes = 0x40000;
constexpr std::int64_t kTail_ticks = 60 * kTicksPerSecond / 1000;

/// An image as the loader leaves it in the flash: with its mark.
std::vector<std::uint8_t> marked(std::vector<std::uint8_t> image) {
  boot_image::SlotHead head;
  if (image.size() < sizeof head) throw host::InputError("the image is too short");
  std::memcpy(&head, image.data(), sizeof head);
  head.mark = boot_image::make_mark(head.image, 1);
  std::memcpy(image.data(), &head, sizeof head);
  return image;
}

/// What arrives on the line, and how long after the light.
class LineLog {
 public:
  /// Bytes that have arrived until `now_ticks`.
  void add(std::span<const std::uint8_t> bytes, std::int64_t now_ticks) {
    if (!bytes.empty() && bytes_.empty()) first_ticks_ = now_ticks;
    for (const std::uint8_t byte : bytes) {
      bytes_.push_back(byte);
      const auto frame = decoder_.push(byte);
      if (frame && frame->type == wire::MessageType::kCounters) add_counters(frame->payload);
      if (!frame || frame->type != wire::MessageType::kSweep) continue;
      const auto sweep = wire::decode_payload<wire::Sweep>(frame->payload);
      if (!sweep || sweep->hits.empty()) continue;
      std::int64_t last_edge = 0;
      for (const wire::SweepHit& hit : sweep->hits) {
        const std::int64_t fall = sweep->flash_start_ticks + (hit.centre_half_ticks + hit.width_ticks) / 2;
        last_edge = std::max(last_edge, fall);
      }
      const std::int64_t latency = now_ticks - last_edge;
      worst_ = std::max(worst_, latency);
      sum_ += latency;
      ++sweeps_;
    }
  }
  const std::vector<std::uint8_t>& bytes() const { return bytes_; }
  /// Of the seconds that ended while it ran; 0 before the first.
  unsigned worst_busy_permille() const { return worst_busy_permille_; }
  /// When the first byte had arrived.
  std::int64_t first_ticks() const { return first_ticks_; }
  double worst_s() const { return ticks_to_seconds(worst_); }
  double mean_s() const { return sweeps_ == 0 ? 0.0 : ticks_to_seconds(sum_ / sweeps_); }

 private:
  void add_counters(std::span<const std::uint8_t> payload) {
    constexpr std::size_t kBusy = 7;  // busy_permille in PHAROS_DEVICE_COUNTERS
    const auto counters = wire::decode_payload<wire::Counters>(payload);
    if (!counters || counters->group != wire::CounterGroup::kDevice || counters->values.size() <= kBusy) return;
    worst_busy_permille_ = std::max<unsigned>(worst_busy_permille_, counters->values[kBusy]);
  }

  std::vector<std::uint8_t> bytes_;
  wire::FrameDecoder decoder_;
  unsigned worst_busy_permille_ = 0;
  std::int64_t first_ticks_ = 0;
  std::int64_t worst_ = 0;
  std::int64_t sum_ = 0;
  std::int64_t sweeps_ = 0;
};

void run_until(ChipBench& bench, std::int64_t end_ticks, LineLog& log) {
  constexpr std::int64_t kStep_ticks = 500;  // 10 us
  while (bench.device().ticks() < end_ticks) {
    bench.run_until(std::min(end_ticks, bench.device().ticks() + kStep_ticks));
    log.add(bench.take_received(), bench.device().ticks());
  }
}

int run(const Arguments& arguments) {
  const ChipLight light = read_light(arguments.edges, arguments.seconds);
  const std::int64_t first = light.first_ticks;
  const std::int64_t last = light.last_ticks;
  const ChipKind& chip = chip_named(arguments.chip);
  ChipBench bench(chip.make());
  std::int64_t lead = kLead_ticks;
  if (!arguments.external.empty()) {
    bench.start_in_sdram(bytes_of(arguments.external));
  } else if (!arguments.flash.empty()) {
    const auto content = bytes_of(arguments.flash);
    if (content.size() != ChipBench::kFlashBytes) throw host::InputError(arguments.flash + ": is not the whole flash");
    lead = kLoaderLead_ticks + kLoaderLeadOfByte_ticks * kSlotBytes;
    bench.flash().content() = content;
    bench.device().set_rom(bytes_of(arguments.loader));
  } else if (arguments.program.empty()) {
    const auto image = marked(bytes_of(arguments.image));
    lead = kLoaderLead_ticks + kLoaderLeadOfByte_ticks * static_cast<std::int64_t>(image.size());
    std::ranges::copy(image, bench.flash().content().begin() + chip.first_slot);
    bench.device().set_rom(bytes_of(arguments.loader));
  } else {
    bench.start_in_ram(bytes_of(arguments.program));
  }
  bench.device().set_ticks(first - lead);
  const auto begin = std::chrono::steady_clock::now();
  bench.power_on();
  bench.set_light(light.pulses);
  LineLog log;
  run_until(bench, first, log);
  (void)bench.take_counts();
  if (arguments.count_from > 0.0) {
    run_until(bench, std::min(last, first + static_cast<std::int64_t>(arguments.count_from * kTicksPerSecond)), log);
    (void)bench.take_counts();
  }
  run_until(bench, last, log);
  const ChipCounts counts = bench.take_counts();
  run_until(bench, last + kTail_ticks, log);
  const auto& frames = log.bytes();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  write_bytes(arguments.output, frames);
  if (!arguments.stamped.empty()) write_pulses(arguments.stamped, bench.stamped());
  std::fprintf(stderr,
               "%zu pulses in %.3f s, %zu bytes sent, %u framing errors; %.3f M instructions, %.3f cycles each, "
               "at most %u records in the FIFO; last edge of a sweep to the end of its frame %.2f ms at worst, %.2f ms "
               "mean; at most %.1f %% busy in a second; %.2f M ticks a second\n",
               light.pulses.size(), ticks_to_seconds(last - first), frames.size(), bench.line().framing_errors(),
               static_cast<double>(counts.instructions) * 1e-6,
               static_cast<double>(counts.ticks) / static_cast<double>(std::max<std::uint64_t>(counts.instructions, 1)),
               counts.worst_fill, log.worst_s() * 1e3, log.mean_s() * 1e3, 0.1 * log.worst_busy_permille(),
               static_cast<double>(last - first + lead + kTail_ticks) * 1e-6 / std::max(seconds, 1e-9));
  if (!arguments.loader.empty()) {
    std::fprintf(stderr, "first byte %.3f s after power on\n", ticks_to_seconds(log.first_ticks() - (first - lead)));
  }
  if (counts.external_fetches != 0) {
    std::fprintf(
        stderr,
        "of the SDRAM: %.3f M instructions fetched, %.2f %% hits; a fetch waits %.3f ticks on average; %.3f M lines "
        "for "
        "instructions, %.3f M accesses for data\n",
        static_cast<double>(counts.external_fetches) * 1e-6,
        100.0 - 100.0 * static_cast<double>(counts.lines_for_code) / static_cast<double>(counts.external_fetches),
        static_cast<double>(counts.fetch_waits) / static_cast<double>(counts.external_fetches),
        static_cast<double>(counts.lines_for_code) * 1e-6, static_cast<double>(counts.accesses_for_data) * 1e-6);
  }
  for (const std::string& violation : bench.sdram().violations()) {
    std::fprintf(stderr, "FAILED: SDRAM: %s\n", violation.c_str());
  }
  if (!bench.sdram().violations().empty()) return 1;
  return frames.empty() ? 1 : 0;
}

}  // namespace
}  // namespace pharos::rtl

int main(int count, char** values) {
  pharos::rtl::Arguments arguments;
  CLI::App app{
      "Runs the decoder on the simulated chip (firmware/rtl/soc), every tick of its clock: EDGES on the photodiodes' "
      "pins,\n"
      "what it sends on its serial line to a file for `pharos decode`.\n"
      "Example: chip_simulator slice.csv --program decoder.ep4ce10.bin --output line"};
  app.add_option("EDGES", arguments.edges, "table sensor,rise_ticks,fall_ticks")->required();
  auto* program = app.add_option("--program", arguments.program, "bytes for the RAM, started without the loader");
  auto* image =
      app.add_option("--image", arguments.image, "image in the first slot of the flash, which the loader starts");
  auto* flash = app.add_option("--flash", arguments.flash,
                               "whole content of the flash, as chip_flash writes it, from which the loader starts");
  app.add_option("--loader", arguments.loader, "bytes of the boot ROM");
  auto* external = app.add_option("--external", arguments.external, "bytes for the SDRAM, started without the loader");
  program->excludes(image)->excludes(external)->excludes(flash);
  external->excludes(image)->excludes(flash);
  flash->excludes(image);
  app.add_option("--output", arguments.output, "file for the bytes of the serial line")->required();
  app.add_option("--chip", arguments.chip, "ep4ce10, or up5k with four inputs")
      ->check(CLI::IsMember({"ep4ce10", "up5k"}));
  app.add_option("--stamped", arguments.stamped,
                 "file for the pulses as the capture block stamped them, a table as EDGES");
  app.add_option("--seconds", arguments.seconds, "seconds of light to simulate");
  app.add_option("--count-from", arguments.count_from,
                 "seconds of light before instructions, cycles and fetches are counted");
  CLI11_PARSE(app, count, values);
  try {
    if (arguments.program.empty() && arguments.external.empty() &&
        (arguments.loader.empty() || (arguments.image.empty() && arguments.flash.empty())))
      throw pharos::host::InputError("--program, --external, or --loader and --image or --flash");
    return pharos::rtl::run(arguments);
  } catch (const pharos::host::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
