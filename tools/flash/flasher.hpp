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

/// Callbacks of a flashing for messages, progress and questions.
struct FlashReports {
  /// One line for the user.
  std::function<void(const std::string&)> note;
  /// Bytes of the image that were acknowledged.
  std::function<void(std::size_t)> progress;
  /// Whether an image older than the running one may be written. `running`: the latter's version.
  std::function<bool(const boot_image::Version& running)> allow_older;
};

struct FlashOptions {
  int baud = 460'800;
  /// Timeout for a target that does not respond.
  std::int64_t wait_ns = 30'000'000'000;
};

/// Result of a flashing.
struct FlashResult {
  std::optional<boot_image::Version> before;  // of the program that ran before, if any
  wire::Hello running;                        // hello of the program that runs now
  std::uint32_t slot_offset = 0;
  std::int64_t line_ns = 0;  // from the first block to the last response
  std::uint64_t blocks_sent = 0;
};

/// Writes an image to a target in any state, and waits until it runs (proto/README.md, "Loader").
class Flasher {
 public:
  Flasher(FlashLine& line, const FlashReports& reports, const FlashOptions& options);

  /// Throws FlashError when flashing fails and host::InputError when the image is not for this target. In both cases
  /// the previous program still starts.
  FlashResult flash(const BootImageFile& image);

 private:
  /// The program or loader that responds.
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
