// SPDX-License-Identifier: Apache-2.0
// `pharos flash` into the simulated chip: loader, verifier and flash as on a board, every tick of its clock.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "host/support/input_error.hpp"
#include "pharos/base/ticks.hpp"
#include "pharos/wire/codec.hpp"
#include "pharos/wire/frame_decoder.hpp"
#include "pharos/wire/hello_message.hpp"
#include "rtl/chip/chip_bench.hpp"
#include "rtl/chip/chip_files.hpp"
#include "rtl/chip/chip_flash_line.hpp"
#include "rtl/chip/chip_kinds.hpp"
#include "tools/flash/flasher.hpp"

namespace pharos::rtl {
namespace {

/// What says Hello first after power on, and the seconds until its first byte.
struct Start {
  double seconds = 0.0;
  std::string runs;  // version of a program; else empty
};

/// The loader waits 0.2 s for a host; an EP4CE10 copies and hashes a byte in 5.3 us, an iCE40UP5K in three times that.
double start_limit_s(std::size_t image_bytes) { return 1.0 + 20e-6 * static_cast<double>(image_bytes); }

Start start(ChipBench& bench, double limit_s) {
  bench.power_on();
  (void)bench.take_received();
  Start start;
  wire::FrameDecoder decoder;
  constexpr std::int64_t kStep_ticks = 500;
  const double tick_hz = bench.device().tick_hz();
  for (std::int64_t ticks = kStep_ticks; static_cast<double>(ticks) < limit_s * tick_hz; ticks += kStep_ticks) {
    bench.run(kStep_ticks);
    for (const std::uint8_t byte : bench.take_received()) {
      if (start.seconds == 0.0) start.seconds = static_cast<double>(ticks) / tick_hz;
      const auto frame = decoder.push(byte);
      if (!frame || frame->type != wire::MessageType::kHello) continue;
      const auto hello = wire::decode_payload<wire::Hello>(frame->payload);
      if (!hello || hello->role == wire::Role::kLoader) return start;
      start.runs = tools::to_text({hello->firmware_major, hello->firmware_minor, hello->firmware_patch});
      return start;
    }
  }
  return start;
}

/// A tenth of an image as it arrives, with the chip's time: a large one takes minutes here.
class Progress {
 public:
  Progress(const std::string& path, std::size_t bytes, ChipFlashLine& line) : path_(path), bytes_(bytes), line_(line) {}
  void operator()(std::size_t arrived) {
    if (arrived * 10 < logged_tenths_ * bytes_) return;
    logged_tenths_ = arrived * 10 / bytes_ + 1;
    std::fprintf(stderr, "%s: %zu of %zu bytes in %.2f s of the chip's time\n", path_.c_str(), arrived, bytes_,
                 static_cast<double>(line_.now_ns()) * 1e-9);
  }

 private:
  const std::string& path_;
  std::size_t bytes_;
  ChipFlashLine& line_;
  std::size_t logged_tenths_ = 1;
};

int run(const ChipKind& chip, const std::vector<std::string>& images, const std::string& loader,
        const std::string& verifier, const std::string& flash) {
  ChipBench bench(chip.make());
  bench.device().set_rom(bytes_of(loader));
  std::ranges::copy(bytes_of(verifier), bench.flash().content().begin() + chip.verifier);
  bench.device().set_ticks(0);
  bench.power_on();
  int refused = 0;
  std::size_t longest_image_bytes = 0;
  std::printf("image,image_bytes,version,transfer_s,verify_s,verify_cycles,verify_instructions,start_s,runs,refusal\n");
  for (const std::string& path : images) {
    const tools::BootImageFile image = tools::read_image(path);
    longest_image_bytes = std::max(longest_image_bytes, image.bytes.size());
    ChipFlashLine line(bench);
    const tools::FlashReports reports{[](const std::string& text) { std::fprintf(stderr, "%s\n", text.c_str()); },
                                      Progress(path, image.bytes.size(), line),
                                      [](const boot_image::Version&) { return true; }};
    std::string refusal;
    tools::FlashResult result;
    try {
      result = tools::Flasher(line, reports, {}).flash(image);
    } catch (const tools::FlashError& error) {
      refusal = error.what();
      ++refused;
    }
    const Start started = start(bench, start_limit_s(longest_image_bytes));
    std::printf("%s,%zu,%s,%.3f,%.4f,%llu,%llu,%.4f,%s,\"%s\"\n", path.substr(path.rfind('/') + 1).c_str(),
                image.bytes.size(), tools::to_text(image.header.version).c_str(),
                static_cast<double>(result.line_ns) * 1e-9,
                static_cast<double>(line.longest_answer.ticks) / chip.core_hz,
                static_cast<unsigned long long>(line.longest_answer.ticks),
                static_cast<unsigned long long>(line.longest_answer.instructions), started.seconds,
                started.runs.c_str(), refusal.c_str());
    std::fflush(stdout);
  }
  if (!flash.empty()) write_bytes(flash, bench.flash().content());
  for (const std::string& violation : bench.sdram().violations()) {
    std::fprintf(stderr, "FAILED: SDRAM: %s\n", violation.c_str());
  }
  if (!bench.sdram().violations().empty()) return 3;
  return refused == 0 ? 0 : 1;
}

}  // namespace
}  // namespace pharos::rtl

int main(int count, char** values) {
  std::vector<std::string> images;
  std::string loader;
  std::string verifier;
  std::string flash;
  std::string chip = pharos::rtl::kChips.front().name;
  CLI::App app{
      "Flashes images one after the other into the simulated chip by its loader, and starts each: a row each.\n"
      "Exit code: 1 where one was refused, 3 where the SDRAM was used against its rules.\n"
      "Example: chip_flash decoder.ep4ce10.image --loader ep4ce10_loader.bin --verifier verifier.bin"};
  app.add_option("IMAGE", images, "images of `pharos flash`")->required();
  app.add_option("--loader", loader, "bytes of the boot ROM")->required();
  app.add_option("--verifier", verifier, "the verifier in flash")->required();
  app.add_option("--flash", flash, "file for the content of the flash after that, for chip_simulator");
  app.add_option("--chip", chip, "ep4ce10 or up5k")->check(CLI::IsMember({"ep4ce10", "up5k"}));
  CLI11_PARSE(app, count, values);
  try {
    return pharos::rtl::run(pharos::rtl::chip_named(chip), images, loader, verifier, flash);
  } catch (const pharos::host::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
