// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

namespace pharos::rtl {

/// A serial NOR flash on the pins (mode 0): READ, PAGE PROGRAM, SECTOR ERASE of 64 KiB, WRITE ENABLE, READ STATUS.
class SpiFlashModel {
 public:
  explicit SpiFlashModel(std::size_t bytes) : content_(bytes, 0xFF) {}

  /// One tick with these levels; the level of its output.
  bool tick(bool select_n, bool clock, bool in);
  std::vector<std::uint8_t>& content() { return content_; }
  /// Ticks that programming a page and erasing a sector take.
  std::uint32_t program_ticks = 500;
  std::uint32_t erase_ticks = 5000;
  std::uint64_t pages_programmed() const { return pages_; }
  std::uint64_t sectors_erased() const { return sectors_; }

 private:
  void take_byte(std::uint8_t byte);
  void execute();

  std::vector<std::uint8_t> content_;
  std::vector<std::uint8_t> page_;
  bool selected_ = false;
  bool last_clock_ = false;
  unsigned bits_ = 0;
  std::uint8_t in_ = 0;
  std::uint8_t out_ = 0xFF;
  bool level_ = true;
  std::uint32_t bytes_ = 0;  // since it was selected
  std::uint8_t command_ = 0;
  std::uint32_t address_ = 0;
  bool writable_ = false;
  std::uint32_t busy_ticks_ = 0;
  std::uint64_t pages_ = 0;
  std::uint64_t sectors_ = 0;
};

}  // namespace pharos::rtl
