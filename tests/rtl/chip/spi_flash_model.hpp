// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <random>
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
  /// A page or sector that was programmed or erased, with the ticks in which that took place.
  struct Change {
    std::uint64_t begins = 0;
    std::uint64_t ends = 0;
    std::size_t offset = 0;
    std::vector<std::uint8_t> before;
    std::vector<std::uint8_t> after;
  };
  const std::vector<Change>& changes() const { return changes_; }
  void forget_changes() { changes_.clear(); }
  std::uint64_t now() const { return now_; }
  /// Bits of the content that read differently each time, as after a cut of power; empty: none.
  std::vector<std::uint8_t> unstable;

 private:
  void take_byte(std::uint8_t byte);
  void execute();
  void change(std::size_t offset, std::vector<std::uint8_t> after, std::uint32_t ticks);

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
  std::uint64_t now_ = 0;
  std::vector<Change> changes_;
  std::minstd_rand noise_;
};

}  // namespace pharos::rtl
