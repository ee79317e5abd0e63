// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "pharos/wire/hello_message.hpp"
#include "pharos/wire/loader_messages.hpp"
#include "tools/flash/boot_image_file.hpp"
#include "tools/flash/flash_session.hpp"

namespace pharos::tools {

/// What a flashing tells while it goes on, and asks.
struct FlashReports {
  /// One line for people.
  std::function<void(const std::string&)> note;
  /// Bytes of the image that have arrived.
  std::function<void(std::size_t)> progress;
  /// Whether an image older than what runs may be written. `running`: its version.
  std::function<bool(const boot_image::Version& running)> allow_older;
};

struct FlashOptions {
  int baud = 460'800;
  /// How long a silent target is waited for.
  std::int64_t wait_ns = 30'000'000'000;
};

/// What came of it.
struct FlashResult {
  std::optional<boot_image::Version> before;  // what ran, where something did
  wire::Hello running;                        // what runs now, in its own words
  std::uint32_t slot_offset = 0;
  std::int64_t line_ns = 0;  // from the first block to the last answer
  std::uint64_t blocks_sent = 0;
};

/// Brings an image into a target, whatever that does at the moment, and waits until it runs (proto/README.md,
/// "Loader").
class Flasher {
 public:
  Flasher(FlashLine& line, const FlashReports& reports, const FlashOptions& options);

  /// Throws FlashError when it does not work out and host::InputError when the image is not for this target. In either
  /// case what ran before still starts.
  FlashResult flash(const BootImageFile& image);

 private:
  /// Who answers.
  struct Peer {
    std::optional<wire::Hello> hello;
    std::optional<wire::LoaderInfo> loader;  // empty: a program runs
  };

  Peer find(std::int64_t wait_ns);
  bool probe(Peer& peer);
  [[noreturn]] void no_reply_text();
  Peer enter_loader(const Peer& program);
  void check(const BootImageFile& image, const Peer& peer);
  void transfer(const BootImageFile& image, const wire::LoaderInfo& loader, FlashResult& result);
  std::uint32_t begin(const BootImageFile& image);
  void verify(const BootImageFile& image);
  void start();
  wire::Hello await_program(const boot_image::BootImageHeader& header);

  FlashSession session_;
  const FlashReports& reports_;
  FlashOptions options_;
  bool older_allowed_ = false;
};

}  // namespace pharos::tools
