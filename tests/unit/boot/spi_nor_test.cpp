// SPDX-License-Identifier: Apache-2.0
// The driver of the board's serial flash with a model of such a chip.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "firmware/board/spi_nor_flash.hpp"
#include "firmware/hal/flash.hpp"

namespace pharos::board {
namespace {

/// M25P16's rules: a command needs its write enable, programming wraps within its page and only clears bits, a busy
/// chip accepts only the read of its status, and commands take effect when the chip is deselected.
class ChipModel {
 public:
  std::vector<std::uint8_t> bytes = std::vector<std::uint8_t>(2 << 20, 0xFF);
  int busy_polls = 3;     // of the status, after a write
  int absent_reads = -1;  // not negative: no chip, the line reads this
  int rule_breaks = 0;

  void select() {
    rule_breaks += selected_;
    selected_ = true;
    received_.clear();
  }
  std::uint8_t exchange(std::uint8_t byte) {
    if (absent_reads >= 0) return static_cast<std::uint8_t>(absent_reads);
    rule_breaks += !selected_;
    received_.push_back(byte);
    const std::size_t at = received_.size() - 1;
    if (at == 0) return 0xFF;
    if (received_[0] == 0x05) return status();
    if (received_[0] == 0x03 && at >= 4) return bytes[(address() + at - 4) % bytes.size()];
    return 0xFF;
  }
  void deselect() {
    selected_ = false;
    if (received_.empty() || received_[0] == 0x05 || absent_reads >= 0) return;
    if (busy_ > 0) {
      ++rule_breaks;
      return;
    }
    switch (received_[0]) {
      case 0x06:
        writable_ = true;
        break;
      case 0x02:
        program();
        break;
      case 0xD8:
        erase();
        break;
      default:
        rule_breaks += received_[0] != 0x03;
    }
  }

 private:
  std::size_t address() const {
    return static_cast<std::size_t>((received_[1] << 16) | (received_[2] << 8) | received_[3]);
  }
  std::uint8_t status() {
    const auto status = static_cast<std::uint8_t>((busy_ > 0 ? 1 : 0) | (writable_ ? 2 : 0));
    if (busy_ > 0 && --busy_ == 0) writable_ = false;
    return status;
  }
  void program() {
    if (!writable_ || received_.size() < 5) {
      ++rule_breaks;
      return;
    }
    const std::size_t page = address() & ~std::size_t{0xFF};
    for (std::size_t i = 4; i < received_.size(); ++i) {
      std::uint8_t& cell = bytes[page | ((address() + i - 4) & 0xFF)];
      cell = static_cast<std::uint8_t>(cell & received_[i]);
    }
    busy_ = busy_polls;
  }
  void erase() {
    if (!writable_ || received_.size() != 4) {
      ++rule_breaks;
      return;
    }
    const auto sector = bytes.begin() + static_cast<std::ptrdiff_t>(address() & ~std::size_t{0xFFFF});
    std::fill(sector, sector + 0x10000, 0xFF);
    busy_ = busy_polls;
  }

  bool selected_ = false;
  bool writable_ = false;
  int busy_ = 0;
  std::vector<std::uint8_t> received_;
};

struct ModelBus {
  inline static ChipModel* chip = nullptr;
  static void select() { chip->select(); }
  static void deselect() { chip->deselect(); }
  static std::uint8_t exchange(std::uint8_t byte) { return chip->exchange(byte); }
};

using Flash = SpiNorFlash<ModelBus>;
static_assert(hal::Flash<Flash>);

class SpiNor : public ::testing::Test {
 protected:
  void SetUp() override { ModelBus::chip = &chip; }
  auto counting() {
    return [this] { ++idles; };
  }

  ChipModel chip;
  int idles = 0;
};

std::array<std::uint8_t, 256> page(std::uint8_t first) {
  std::array<std::uint8_t, 256> bytes{};
  for (std::uint8_t& byte : bytes) byte = first++;
  return bytes;
}

TEST_F(SpiNor, ReadsWhatItProgrammedAndErasesASectorAlone) {
  const auto written = page(3);
  EXPECT_TRUE(Flash::program(0x123400, written, counting()));
  EXPECT_GE(idles, 256 + chip.busy_polls) << "the serial line is looked after at every byte and look";
  EXPECT_TRUE(Flash::program(0x130000, written, counting()));
  std::array<std::uint8_t, 256> read{};
  Flash::read(0x123400, read);
  EXPECT_EQ(read, written);
  EXPECT_TRUE(Flash::erase_sector(0x120000, counting()));
  Flash::read(0x123400, read);
  EXPECT_TRUE(std::ranges::all_of(read, [](std::uint8_t byte) { return byte == 0xFF; }));
  Flash::read(0x130000, read);
  EXPECT_EQ(read, written);
  EXPECT_EQ(chip.rule_breaks, 0);
}

TEST_F(SpiNor, ProgramsAPageInParts) {
  const auto written = page(0);
  EXPECT_TRUE(Flash::program(0x100000, std::span(written).first(64), counting()));
  EXPECT_TRUE(Flash::program(0x100040, std::span(written).subspan(64, 8), counting()));
  std::array<std::uint8_t, 72> read{};
  Flash::read(0x100000, read);
  EXPECT_TRUE(std::equal(read.begin(), read.end(), written.begin()));
  EXPECT_EQ(chip.rule_breaks, 0);
}

TEST_F(SpiNor, SaysWhereNoChipAnswers) {
  for (const int line : {0x00, 0xFF}) {
    chip.absent_reads = line;
    EXPECT_FALSE(Flash::program(0, page(0), counting())) << line;
    EXPECT_FALSE(Flash::erase_sector(0, counting())) << line;
  }
}

TEST_F(SpiNor, GivesUpAChipThatStaysBusy) {
  chip.busy_polls = INT32_MAX;
  EXPECT_FALSE(Flash::erase_sector(0, counting()));
}

}  // namespace
}  // namespace pharos::board
