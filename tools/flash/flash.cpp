// SPDX-License-Identifier: Apache-2.0
// pharos flash: a decoder image into a target's flash, verified and started.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <string>

#include "tools/flash/flasher.hpp"
#include "tools/flash/serial_flash_line.hpp"
#include "tools/support/commands.hpp"
#include "tools/support/output.hpp"
#include "tools/support/progress.hpp"

namespace pharos::tools {
namespace {

constexpr const char* kExample =
    "Example:\n"
    "  pharos flash /dev/serial/by-id/usb-target build/firmware/bin/decoder.ep4ce10.image\n"
    "The target keeps two images. The one that runs stays until the other is whole: power or line may fail at any "
    "moment.\n"
    "A target that no longer answers is reached while it starts: run this, then switch it off and on.\n"
    "A port that pharosd holds is refused: sudo systemctl stop pharosd, and start it afterwards.";

struct Options {
  std::string port;
  std::string image;
  FlashOptions flash;
  double wait_s = 30.0;
  bool allow_older = false;
  OutputOptions output;
};

/// Asks on the terminal; false where there is no terminal.
bool ask_about_older(const boot_image::Version& image, const boot_image::Version& running) {
  if (isatty(STDIN_FILENO) == 0) return false;
  std::cerr << "the image is version " << to_text(image) << ", older than " << to_text(running)
            << " that is there: write it? [y/N] " << std::flush;
  std::string answer;
  std::getline(std::cin, answer);
  return answer == "y" || answer == "yes";
}

const std::vector<std::string> kColumns = {"board",       "name",        "version", "version_before",
                                           "image_bytes", "slot_offset", "line_s"};

void write_row(const BootImageFile& image, const FlashResult& flashed, host::RowWriter& rows) {
  rows.text(flashed.running.board.view()).text(view(image.header.name)).text(to_text(image.header.version));
  flashed.before ? rows.text(to_text(*flashed.before)) : rows.none();
  rows.integer(static_cast<std::int64_t>(image.bytes.size())).integer(flashed.slot_offset);
  rows.number(static_cast<double>(flashed.line_ns) * 1e-9).end_row();
}

int run(Options options) {
  const BootImageFile image = read_image(options.image);
  options.flash.wait_ns = static_cast<std::int64_t>(options.wait_s * 1e9);
  SerialFlashLine line(options.port, options.flash.baud);
  std::unique_ptr<Progress> progress;
  std::size_t arrived = 0;
  FlashReports reports;
  reports.note = [&](const std::string& text) {
    progress.reset();
    note(text);
  };
  reports.progress = [&](std::size_t bytes) {
    if (!progress) {
      progress = std::make_unique<Progress>("writing", "bytes", image.bytes.size());
      arrived = 0;
    }
    progress->step(bytes - arrived);
    arrived = bytes;
  };
  reports.allow_older = [&](const boot_image::Version& running) {
    return options.allow_older || ask_about_older(image.header.version, running);
  };
  try {
    const FlashResult flashed = Flasher(line, reports, options.flash).flash(image);
    progress.reset();
    Output output(options.output, kColumns);
    write_row(image, flashed, output.rows());
    output.finish();
    return kExitAnswered;
  } catch (const FlashError& error) {
    progress.reset();
    note(options.port + ": " + error.what());
    return kExitNoAnswer;
  }
}

}  // namespace

void add_flash(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("flash", "Write a decoder image into a target, verify and start it");
  const auto options = std::make_shared<Options>();
  command->add_option("PORT", options->port, "Serial port of the target")->required();
  command->add_option("IMAGE", options->image, "The image (NAME.image of the firmware build)")->required();
  command->add_option("--baud", options->flash.baud, "Speed of the line")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  command->add_option("--wait", options->wait_s, "Seconds to wait for a target that does not answer")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 86'400.0));
  command->add_flag("-y,--yes,--allow-older", options->allow_older,
                    "Write an image older than what runs without asking");
  add_output_options(*command, options->output);
  command->footer(kExample);
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace pharos::tools
