// SPDX-License-Identifier: Apache-2.0
#include "firmware/boot/retained.hpp"

#include <gtest/gtest.h>

namespace pharos::boot {
namespace {

/// What memory holds after power was away.
Retained anything() { return {0x12345678, 0x9ABCDEF0, 1, 0xFFFFFFFF, 77, 1, 2, 3}; }

TEST(Retained, TellsPowerOnFromAReset) {
  Retained retained = anything();
  EXPECT_EQ(last_reset(retained), wire::ResetCause::kUnknown);
  note_reset(retained);
  EXPECT_EQ(last_reset(retained), wire::ResetCause::kPowerOn);
  EXPECT_EQ(retained.start_count, 1u);
  EXPECT_EQ(retained.fault_cause, 0u);
  EXPECT_FALSE(take_loader_request(retained));
}

TEST(Retained, AResetThatNobodyAnnouncedIsTheWatchdogs) {
  Retained retained = anything();
  note_reset(retained);
  note_reset(retained);
  EXPECT_EQ(last_reset(retained), wire::ResetCause::kWatchdog);
  EXPECT_EQ(retained.start_count, 2u);
}

TEST(Retained, KeepsWhatWasAnnouncedForOneReset) {
  Retained retained = anything();
  note_reset(retained);
  retained.fault_address = 0x80001234;
  announce_reset(retained, wire::ResetCause::kFault);
  note_reset(retained);
  EXPECT_EQ(last_reset(retained), wire::ResetCause::kFault);
  EXPECT_EQ(retained.fault_address, 0x80001234u);
  EXPECT_FALSE(take_loader_request(retained));

  announce_reset(retained, wire::ResetCause::kCommand, true);
  note_reset(retained);
  EXPECT_EQ(last_reset(retained), wire::ResetCause::kCommand);
  EXPECT_TRUE(take_loader_request(retained));
  EXPECT_FALSE(take_loader_request(retained)) << "asked for once";
  note_reset(retained);
  EXPECT_EQ(last_reset(retained), wire::ResetCause::kWatchdog);
}

}  // namespace
}  // namespace pharos::boot
