// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace pharos::rtl {

/// Pins of an SDRAM at a rising edge of its clock. Chip select is low, clock enable high.
struct SdramPins {
  bool ras_n = true;
  bool cas_n = true;
  bool we_n = true;
  std::uint32_t bank = 0;
  std::uint32_t address = 0;  // row, column, mode; A10
  std::uint32_t mask = 0;
  bool driven = false;  // the data pins, from outside
  std::uint16_t data = 0;
};

/// An SDRAM of 256 Mbit: 4 banks, 8,192 rows, of which the first 2,048 (8 MiB) are there, 512 columns of 16 bits, at 50
/// MHz. Keeps the rules of its data sheet for the slowest grade (-75) and reports whoever breaks one.
class SdramModel {
 public:
  SdramModel();

  /// One rising edge of its clock with these pins; the data pins until the next one.
  std::uint16_t tick(const SdramPins& pins);
  /// Power on, with what is stored: from the initialisation on.
  void restart();
  /// What was done against the rules, in the order in which it was; empty: nothing.
  const std::vector<std::string>& violations() const { return violations_; }
  /// Bytes as the chip addresses them, from the first of the SDRAM on.
  void write(std::uint32_t offset, std::span<const std::uint8_t> bytes);
  std::uint8_t read(std::uint32_t offset) const;
  std::uint64_t refreshes() const { return refreshes_; }

 private:
  struct Bank {
    bool open = false;
    std::uint32_t row = 0;
    std::int64_t opened = kLongAgo;
    std::int64_t closes = kNever;     // by itself
    std::int64_t closed = kLongAgo;   // begins to close
    std::int64_t written = kLongAgo;  // last data of a write
  };
  static constexpr std::int64_t kLongAgo = -1'000'000;
  static constexpr std::int64_t kNever = INT64_MAX;

  void command(const SdramPins& pins);
  void open(const SdramPins& pins);
  void access(const SdramPins& pins, bool write);
  void close(const SdramPins& pins);
  void refresh();
  void set_mode(const SdramPins& pins);
  void require(bool holds, const char* rule);
  void require_all_closed(const char* rule);
  std::uint16_t& at(std::uint32_t bank, std::uint32_t column);

  std::vector<std::uint16_t> content_;
  std::vector<std::string> violations_;
  std::array<Bank, 4> banks_;
  std::int64_t now_ = 0;
  // Initialisation.
  std::int64_t started_ = 0;
  bool all_closed_once_ = false;
  unsigned refreshes_before_mode_ = 0;
  std::int64_t mode_set_ = kLongAgo;
  bool ready_ = false;
  std::int64_t refreshed_ = kLongAgo;
  std::int64_t owed_half_ns_ = 0;  // time since the last refresh, less what came early
  std::uint64_t refreshes_ = 0;
  std::int64_t last_opened_ = kLongAgo;  // any bank
  // A burst that is read.
  std::int64_t burst_begins_ = kNever;
  unsigned burst_left_ = 0;
  std::uint32_t burst_bank_ = 0;
  std::uint32_t burst_row_ = 0;
  std::uint32_t burst_column_ = 0;
  bool shown_ = false;  // data were on the pins before this edge
};

}  // namespace pharos::rtl
