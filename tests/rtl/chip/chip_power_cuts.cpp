// SPDX-License-Identifier: Apache-2.0
// Cuts of the chip's power while its loader takes a new image from the line: at every cut one whole image starts, the
// old or the new one.
//
// All that outlives a cut is the flash. So each flashing is simulated once, with all changes of the flash and their
// times; a cut is the flash as it was then, with the change that was on its way done in part, and the chip is started
// from it with anything in its RAM.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <random>

#include "host/support/input_error.hpp"
#include "pharos/boot_image/slot.hpp"
#include "rtl/chip/chip_bench.hpp"
#include "rtl/chip/chip_files.hpp"
#include "rtl/chip/chip_flash_line.hpp"
#include "rtl/chip/chip_kinds.hpp"
#include "tools/flash/flasher.hpp"

namespace pharos::rtl {
namespace {

constexpr std::uint32_t kSlotBytes = 0x40000;
const ChipKind& kChip = kChips.front();

using Bytes = std::vector<std::uint8_t>;

std::uint32_t slot_at(std::uint32_t number) { return kChip.first_slot + number * kSlotBytes; }

void put_marked(Bytes& flash, std::uint32_t slot, Bytes image, std::uint32_t sequence) {
  boot_image::SlotHead head;
  std::memcpy(&head, image.data(), sizeof head);
  head.mark = boot_image::make_mark(head.image, sequence);
  std::memcpy(image.data(), &head, sizeof head);
  std::ranges::copy(image, flash.begin() + slot_at(slot));
}

/// A flashing: the flash before it, what changed and when, and who runs before and after.
struct Flashing {
  Bytes before;
  std::vector<SpiFlashModel::Change> changes;
  std::uint64_t begins = 0;
  std::uint64_t ends = 0;
  unsigned old_image = 0;
  unsigned new_image = 0;
  const SpiFlashModel::Change& mark() const { return changes.back(); }
};

struct Marked {};  // thrown when the slot has its mark

Flashing record(ChipBench& bench, const std::string& path, unsigned old_image, unsigned new_image) {
  constexpr std::uint64_t kAfter_ticks = 50'000;
  SpiFlashModel& flash = bench.flash();
  Flashing flashing;
  flashing.before = flash.content();
  flashing.old_image = old_image;
  flashing.new_image = new_image;
  flash.forget_changes();
  flashing.begins = flash.now();
  bench.device().set_ticks(0);
  bench.power_on();
  ChipFlashLine line(bench);
  line.before_step = [&flash](std::int64_t, std::int64_t ticks) {
    const auto is_mark = [](const SpiFlashModel::Change& change) {
      return change.after.size() == boot_image::kPageBytes && (change.offset - kChip.first_slot) % kSlotBytes == 0;
    };
    if (!flash.changes().empty() && is_mark(flash.changes().back()) &&
        flash.now() > flash.changes().back().ends + kAfter_ticks)
      throw Marked{};
    return ticks;
  };
  const tools::FlashReports reports{[](const std::string&) {}, [](std::size_t) {},
                                    [](const boot_image::Version&) { return true; }};
  try {
    (void)tools::Flasher(line, reports, {}).flash(tools::read_image(path));
    throw host::InputError(path + ": no slot was marked");
  } catch (const Marked&) {
  }
  flashing.changes = flash.changes();
  flashing.ends = flash.now();
  return flashing;
}

/// Times of cuts: a third anywhere, a third while the flash changes, a third while the mark is written.
std::uint64_t time_of_cut(const Flashing& flashing, unsigned number, std::mt19937& random) {
  const auto between = [&random](std::uint64_t begin, std::uint64_t end) {
    return std::uniform_int_distribution(begin, end)(random);
  };
  const auto& changes = flashing.changes;
  switch (number % 3) {
    case 0:
      return between(flashing.begins, flashing.ends);
    case 1: {
      const auto& change = changes[random() % changes.size()];
      return between(change.begins, change.ends);
    }
    default:
      return between(flashing.mark().begins - 100, flashing.mark().ends + 100);
  }
}

/// The flash after a cut; bits of the change that was on its way are as before, as after, or unstable.
void cut(const Flashing& flashing, std::uint64_t when, std::mt19937& random, SpiFlashModel& flash) {
  Bytes& content = flash.content();
  content = flashing.before;
  flash.unstable.clear();
  for (const SpiFlashModel::Change& change : flashing.changes) {
    if (when <= change.begins) break;
    if (when >= change.ends) {
      std::ranges::copy(change.after, content.begin() + static_cast<std::ptrdiff_t>(change.offset));
      continue;
    }
    const double done = static_cast<double>(when - change.begins) / static_cast<double>(change.ends - change.begins);
    const bool unstable = random() % 2 == 0;
    if (unstable) flash.unstable.assign(content.size(), 0);
    std::bernoulli_distribution changed(done);
    for (std::size_t i = 0; i < change.after.size(); ++i) {
      const auto differs = static_cast<std::uint8_t>(change.before[i] ^ change.after[i]);
      if (differs == 0) continue;
      std::uint8_t flips = 0;
      for (unsigned bit = 0; bit < 8; ++bit)
        flips = static_cast<std::uint8_t>(flips | (changed(random) ? 1U << bit : 0));
      content[change.offset + i] = static_cast<std::uint8_t>(change.before[i] ^ (differs & flips));
      if (unstable) flash.unstable[change.offset + i] = static_cast<std::uint8_t>(differs & random());
    }
  }
}

/// The number of the program that runs after power on; 0: none.
unsigned start(ChipBench& bench, std::mt19937& random) {
  constexpr std::int64_t kStep_ticks = 50'000, kMax_ticks = 20'000'000, kAhead_ticks = 1'000'000;
  constexpr std::size_t kEnough = 8;
  Bytes anything(0x8000);
  for (std::uint8_t& byte : anything) byte = static_cast<std::uint8_t>(random());
  bench.device().set_ram(anything);
  bench.sdram().write(0, anything);
  bench.device().set_ticks(0);
  bench.power_on();
  (void)bench.take_received();
  Bytes last;
  for (std::int64_t ticks = 0; ticks < kMax_ticks; ticks += kStep_ticks) {
    bench.run(kStep_ticks);
    for (const std::uint8_t byte : bench.take_received()) {
      if (!last.empty() && last.back() != byte) last.clear();
      last.push_back(byte);
      if (last.size() >= kEnough && byte > 0xA0 && byte <= 0xA3) return byte - 0xA0U;
    }
    bench.device().set_ticks(bench.device().ticks() + kAhead_ticks);  // the loader waits 0.2 s for a host
  }
  return 0;
}

int run(const std::string& images, unsigned cuts, unsigned flashings, unsigned seed) {
  std::array<std::string, 4> paths;  // by the number of the program
  for (unsigned i = 1; i <= 3; ++i) paths[i] = images + "/chip_probe_" + std::to_string(i) + ".image";
  ChipBench bench(kChip.make());
  bench.device().set_rom(bytes_of(images + "/ep4ce10_loader.bin"));
  std::ranges::copy(bytes_of(images + "/verifier.bin"), bench.flash().content().begin() + kChip.verifier);
  put_marked(bench.flash().content(), 0, bytes_of(paths[1]), 1);
  put_marked(bench.flash().content(), 1, bytes_of(paths[2]), 3);
  std::mt19937 random(seed);
  std::vector<Flashing> recorded{record(bench, paths[3], 2, 3)};         // to an empty slot
  if (flashings > 1) recorded.push_back(record(bench, paths[1], 3, 1));  // over an old image
  std::array<unsigned, 4> runs{};
  for (unsigned number = 0; number < cuts; ++number) {
    const Flashing& flashing = recorded[number % recorded.size()];
    const std::uint64_t when = time_of_cut(flashing, number, random);
    cut(flashing, when, random, bench.flash());
    const unsigned image = start(bench, random);
    const bool may_be_old = when < flashing.mark().ends;
    const bool may_be_new = when > flashing.mark().begins;
    if ((image != flashing.old_image || !may_be_old) && (image != flashing.new_image || !may_be_new)) {
      std::printf("FAILED: cut %u, seed %u, tick %llu of %llu: image %u runs, %u before and %u after it\n", number,
                  seed, static_cast<unsigned long long>(when - flashing.begins),
                  static_cast<unsigned long long>(flashing.ends - flashing.begins), image, flashing.old_image,
                  flashing.new_image);
      return 1;
    }
    ++runs[image == flashing.new_image ? 1 : 0];
  }
  // The same where the loader had written to the slot that runs: another image starts, and that is seen.
  Flashing wrong = recorded.front();
  for (SpiFlashModel::Change& change : wrong.changes) change.offset -= kSlotBytes;
  cut(wrong, wrong.mark().begins, random, bench.flash());
  if (start(bench, random) == wrong.old_image) {
    std::printf("FAILED: a slot that was written over still starts\n");
    return 1;
  }
  for (const std::string& violation : bench.sdram().violations()) std::printf("FAILED: SDRAM: %s\n", violation.c_str());
  std::printf("%u power cuts in %zu flashings, seed %u: %u times the old image, %u times the new one, never another\n",
              cuts, recorded.size(), seed, runs[0], runs[1]);
  return bench.sdram().violations().empty() ? 0 : 1;
}

}  // namespace
}  // namespace pharos::rtl

int main(int count, char** values) {
  std::string images;
  unsigned cuts = 200;
  unsigned flashings = 2;
  unsigned seed = 1;
  CLI::App app{
      "Cuts the power of the simulated chip while its loader takes an image. 77: the images are not built.\nExample: "
      "chip_power_cuts build/firmware/bin --cuts 200"};
  app.add_option("IMAGES", images, "folder of the images, the loader and the verifier")->required();
  app.add_option("--cuts", cuts, "how many");
  app.add_option("--flashings", flashings, "1: to an empty slot; 2: also over an old image");
  app.add_option("--seed", seed, "of the times and of what is written in part");
  CLI11_PARSE(app, count, values);
  if (!std::ifstream(images + "/chip_probe_1.image")) {
    std::printf("skipped: the images are not built (target firmware)\n");
    return 77;
  }
  try {
    return pharos::rtl::run(images, cuts, flashings, seed);
  } catch (const pharos::host::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
