// SPDX-License-Identifier: Apache-2.0
// The cache and the SDRAM's controller (firmware/rtl/soc) on the model of the SDRAM, which reports each broken rule of
// its data sheet.
#include <gtest/gtest.h>

#include "rtl/memory/memory_rig.hpp"

namespace pharos::rtl {
namespace {

constexpr std::uint32_t kLine = 4;             // words
constexpr std::uint32_t kCache = 128 * kLine;  // words; the same place in the cache

class Memory : public testing::Test {
 protected:
  ~Memory() override {
    for (const std::string& violation : rig_.sdram().violations()) ADD_FAILURE() << violation;
  }
  /// Stores a number in each word of so many from `word` on.
  void fill(std::uint32_t word, std::uint32_t count) {
    for (std::uint32_t i = 0; i < count; ++i) {
      rig_.store(word + i, 0xF, 0x1000'0000 * (i + 1) + word + i);
      rig_.finish_data();
    }
    rig_.rest();
  }

  MemoryRig rig_;
};

TEST_F(Memory, StoresBytesThatArriveInTheSdram) {
  for (std::uint32_t bytes = 1; bytes < 16; ++bytes) {
    rig_.store(100 + bytes, bytes, 0x44332211);
    rig_.finish_data();
  }
  rig_.rest();
  for (std::uint32_t bytes = 1; bytes < 16; ++bytes) {
    for (std::uint32_t i = 0; i < 4; ++i) {
      EXPECT_EQ(rig_.sdram().read(4 * (100 + bytes) + i), rig_.expected(100 + bytes) >> 8 * i & 0xFF);
    }
  }
}

TEST_F(Memory, RequestsWaitUntilTheSdramHasStarted) {
  const std::uint64_t before = rig_.fetched();
  rig_.power_on(true);
  rig_.rest();
  EXPECT_GT(rig_.fetched(), before);
}

TEST_F(Memory, EveryAddressBitSelectsAnotherWord) {
  rig_.store(0, 0xF, 1);
  rig_.finish_data();
  for (std::uint32_t bit = 0; bit < 21; ++bit) {
    rig_.store(1U << bit, 0xF, 100 + bit);
    rig_.finish_data();
  }
  rig_.rest();
  EXPECT_EQ(rig_.sdram().read(0), 1);
  for (std::uint32_t bit = 0; bit < 21; ++bit) {
    EXPECT_EQ(rig_.sdram().read(4U << bit), 100 + bit);
    rig_.load(1U << bit);
    rig_.finish_data();
    rig_.fetch(1U << bit);
  }
  rig_.tick(false);
  EXPECT_EQ(rig_.loaded(), 21U);
}

TEST_F(Memory, GivesTheWordThatIsAskedForFirstAndTheOthersAsTheyArrive) {
  fill(0, 8);
  EXPECT_EQ(rig_.fetch(0), 8);  // seven ticks of waiting
  EXPECT_EQ(rig_.fetch(1), 2);
  EXPECT_EQ(rig_.fetch(2), 2);
  EXPECT_EQ(rig_.fetch(3), 2);
  EXPECT_EQ(rig_.fetch(6), 8);  // the line's other half comes after it
  EXPECT_EQ(rig_.fetch(7), 2);
  rig_.rest();
  for (std::uint32_t word = 0; word < 8; ++word) EXPECT_EQ(rig_.fetch(word), 1) << word;
}

TEST_F(Memory, KeepsALineUntilAnotherTakesItsPlace) {
  fill(0, 4);
  fill(kCache, 4);
  rig_.fetch(0);
  rig_.rest();
  EXPECT_EQ(rig_.fetch(3), 1);
  rig_.fetch(kLine);
  rig_.rest();
  EXPECT_EQ(rig_.fetch(0), 1);
  EXPECT_GT(rig_.fetch(kCache), 1);
  rig_.rest();
  EXPECT_GT(rig_.fetch(0), 1);
}

TEST_F(Memory, AStoreTakesItsLineOutOfTheCache) {
  fill(0, 4);
  rig_.fetch(0);
  rig_.rest();
  rig_.store(2, 0xF, 77);
  rig_.finish_data();
  rig_.rest();
  EXPECT_GT(rig_.fetch(2), 1);  // and it is the new word: the rig compares
}

TEST_F(Memory, ALoadBringsItsLineForInstructionsToo) {
  fill(40, 4);
  rig_.load(42);
  EXPECT_EQ(rig_.finish_data(), 14);
  EXPECT_EQ(rig_.fetch(41), 1);
}

TEST_F(Memory, AFetchThatIsWithdrawnInAMissHarmsNothing) {
  fill(0, 8);
  fill(kCache, 8);
  for (std::int64_t after = 0; after < 16; ++after) {
    rig_.fetch(kCache);
    rig_.rest();
    rig_.tick(false, 1);
    for (std::int64_t i = 0; i < after; ++i) rig_.tick(true);
    rig_.tick(true, kCache + 2);
    for (std::uint32_t i = 0; i < 6; ++i) rig_.fetch(kCache + 2 + i);
    for (std::uint32_t i = 0; i < 4; ++i) rig_.fetch(i);
    rig_.rest();
  }
}

TEST_F(Memory, ARefreshComesInTimeAlsoUnderLoad) {
  const std::uint64_t before = rig_.sdram().refreshes();
  constexpr std::int64_t kTicks = 40'000;
  for (std::uint32_t word = 0, ticks = 0; ticks < kTicks; ++ticks) {
    if (!rig_.data_pending()) rig_.load(word += kLine);
    rig_.tick(true, ticks % 3 == 0 ? std::optional<std::uint32_t>(ticks * kLine) : std::nullopt);
  }
  EXPECT_GE(rig_.sdram().refreshes() - before, static_cast<std::uint64_t>(kTicks * 20 / 7812));
}

TEST_F(Memory, AStoreThatAResetCutsOffChangesNothingElse) {
  fill(0, 8);
  for (std::int64_t after = 0; after < 16; ++after) {
    rig_.store(1, 0xF, 0xDEADDEAD);
    for (std::int64_t i = 0; i < after && rig_.data_pending(); ++i) rig_.tick(false);
    rig_.reset();
    rig_.store(1, 0xF, 5);
    rig_.finish_data();
    for (std::uint32_t i = 0; i < 8; ++i) rig_.fetch(i);
  }
}

TEST_F(Memory, AResetInAnyTickOfAnAccessLeavesNoWrongLine) {
  fill(0, 4);
  fill(kCache, 4);
  for (std::int64_t after = 1; after < 16; ++after) {
    rig_.fetch(0);
    rig_.rest();
    rig_.tick(false, kCache);
    for (std::int64_t i = 0; i < after; ++i) rig_.tick(true);
    rig_.reset();
    for (std::uint32_t i = 0; i < 4; ++i) rig_.fetch(i);
    for (std::uint32_t i = 0; i < 4; ++i) rig_.fetch(kCache + i);
  }
}

TEST_F(Memory, TheResetKeyInAnyTickOfAnAccessLeavesNoWrongLine) {
  fill(0, 4);
  fill(kCache, 4);
  for (std::int64_t after = 1; after < 16; ++after) {
    rig_.fetch(0);
    rig_.rest();
    rig_.tick(false, kCache);
    for (std::int64_t i = 0; i < after; ++i) rig_.tick(true);
    rig_.power_on();
    for (std::uint32_t i = 0; i < 4; ++i) rig_.fetch(i);
    for (std::uint32_t i = 0; i < 4; ++i) rig_.fetch(kCache + i);
  }
}

TEST_F(Memory, AnswersRandomTrafficAsAPlainMemoryDoes) {
  std::mt19937 random(4);
  const auto one_of = [&random](std::uint32_t count) { return static_cast<std::uint32_t>(random() % count); };
  // Few lines of few tags, so that all of them meet; now and then anywhere.
  const auto any = [&random] { return static_cast<std::uint32_t>(random()); };
  const auto word = [&] { return one_of(20) == 0 ? any() : one_of(4) * kCache + one_of(3) * kLine + one_of(kLine); };
  for (int i = 0; i < 150'000; ++i) {
    if (!rig_.data_pending() && one_of(30) == 0) {
      one_of(3) == 0 ? rig_.store(word(), 1 + one_of(15), any()) : rig_.load(word());
    }
    rig_.tick(one_of(4) != 0, one_of(9) == 0 ? std::optional<std::uint32_t>(word()) : std::nullopt);
    if (HasFailure()) return;
  }
  EXPECT_GT(rig_.fetched(), 10'000U);
  EXPECT_GT(rig_.loaded(), 1'000U);
}

}  // namespace
}  // namespace pharos::rtl
