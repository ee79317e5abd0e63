// SPDX-License-Identifier: Apache-2.0
// The model of the SDRAM reports each rule that is broken: otherwise its silence would mean nothing.
#include "rtl/chip/sdram_model.hpp"

#include <gtest/gtest.h>

namespace pharos::rtl {
namespace {

constexpr SdramPins kNothing{};
constexpr SdramPins kCloseAll{.ras_n = false, .we_n = false, .address = 0x400};
constexpr SdramPins kRefresh{.ras_n = false, .cas_n = false};
constexpr SdramPins kSetMode{.ras_n = false, .cas_n = false, .we_n = false, .address = 0x223};
constexpr SdramPins kOpen{.ras_n = false, .address = 5};
constexpr SdramPins kRead{.cas_n = false, .address = 0x400};
constexpr SdramPins kWrite{.cas_n = false, .we_n = false, .address = 0x400, .driven = true, .data = 0x1234};

class Sdram : public testing::Test {
 protected:
  std::uint16_t give(const SdramPins& pins, int rest = 0) {
    const std::uint16_t data = model_.tick(pins);
    for (int i = 0; i < rest; ++i) model_.tick(kNothing);
    return data;
  }
  void start(int refreshes = 8) {
    give(kNothing, 10'000);
    give(kCloseAll, 1);
    for (int i = 0; i < refreshes; ++i) give(kRefresh, 3);
    give(kSetMode, 1);
  }
  std::string told() const { return model_.violations().empty() ? "" : model_.violations().front(); }
  bool tells(const std::string& rule) const { return told().find(": " + rule) != std::string::npos; }

  SdramModel model_;
};

TEST_F(Sdram, AcceptsWhatTheDataSheetAllows) {
  start();
  give(kOpen);
  give(kWrite, 5);
  give(kOpen);
  EXPECT_EQ(give(kRead), 0xDEAD);
  EXPECT_EQ(give(kNothing), 0x1234);  // two edges after the command
  give(kNothing, 8);
  give(kRefresh, 3);
  EXPECT_EQ(told(), "");
}
TEST_F(Sdram, TellsACommandInTheFirst200Microseconds) {
  give(kNothing, 9'000);
  give(kCloseAll);
  EXPECT_TRUE(tells("a command in the first 200 us"));
}
TEST_F(Sdram, TellsAModeAfterTooFewRefreshes) {
  start(7);
  EXPECT_TRUE(tells("the mode is set before eight refreshes"));
}
TEST_F(Sdram, TellsAnotherMode) {
  give(kNothing, 10'000);
  give(kCloseAll, 1);
  for (int i = 0; i < 8; ++i) give(kRefresh, 3);
  SdramPins mode = kSetMode;
  mode.address = 0x233;  // latency 3
  give(mode);
  EXPECT_TRUE(tells("another mode"));
}
TEST_F(Sdram, TellsARefreshBeforeAllBanksWereClosed) {
  give(kNothing, 10'000);
  give(kRefresh);
  EXPECT_TRUE(tells("a refresh before all banks were closed"));
}
TEST_F(Sdram, TellsARowBeforeTheMode) {
  give(kNothing, 10'000);
  give(kOpen);
  EXPECT_TRUE(tells("a row opens before the mode is set"));
}
TEST_F(Sdram, TellsACommandTooSoonAfterTheMode) {
  give(kNothing, 10'000);
  give(kCloseAll, 1);
  for (int i = 0; i < 8; ++i) give(kRefresh, 3);
  give(kSetMode);
  give(kOpen);
  EXPECT_TRUE(tells("a command within tMRD"));
}
TEST_F(Sdram, TellsACommandTooSoonAfterARefresh) {
  start();
  give(kRefresh, 2);
  give(kOpen);
  EXPECT_TRUE(tells("a command within tRFC"));
}
TEST_F(Sdram, TellsARowThatOpensTooSoon) {
  start();
  give(kOpen);
  give(kWrite, 1);
  give(kOpen);
  EXPECT_TRUE(tells("a row opens w"));  // where one is open, or within tRP
}
TEST_F(Sdram, TellsAnAccessWithoutARow) {
  start();
  give(kRead);
  EXPECT_TRUE(tells("a read where no row is open"));
}
TEST_F(Sdram, TellsAnAccessWhileABurstIsRead) {
  start();
  give(kOpen);
  give(kRead);
  give({.ras_n = false, .bank = 1, .address = 5});
  give({.cas_n = false, .bank = 1, .address = 0x400});
  EXPECT_TRUE(tells("an access while a burst is read"));
}
TEST_F(Sdram, TellsARefreshWhileARowIsOpen) {
  start();
  give(kOpen, 4);
  give(kRefresh);
  EXPECT_TRUE(tells("a refresh while a bank is open"));
}
TEST_F(Sdram, TellsAMissingRefresh) {
  start();
  give(kNothing, 380);
  EXPECT_EQ(told(), "");
  give(kNothing, 40);
  EXPECT_TRUE(tells("no refresh in 7.8 us"));
}
TEST_F(Sdram, TellsARefreshThatIsLateOnAverage) {
  start();
  for (int i = 0; i < 400; ++i) give(kRefresh, 391);
  EXPECT_TRUE(tells("no refresh in 7.8 us"));
}
TEST_F(Sdram, TellsTwoThatDriveTheData) {
  start();
  give(kOpen);
  give(kRead, 1);
  give({.driven = true});
  EXPECT_TRUE(tells("both ends drive the data"));
}
TEST_F(Sdram, TellsAWriteThatNothingDrives) {
  start();
  give(kOpen);
  SdramPins write = kWrite;
  write.driven = false;
  give(write);
  EXPECT_TRUE(tells("nothing drives the data of a write"));
}
TEST_F(Sdram, TellsARowThatStaysOpen) {
  start();
  give(kOpen, 5'001);
  EXPECT_FALSE(model_.violations().empty());
}

}  // namespace
}  // namespace pharos::rtl
