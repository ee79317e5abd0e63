// SPDX-License-Identifier: Apache-2.0
#include "firmware/boot/retained.hpp"

#include <gtest/gtest.h>

namespace pharos::boot {
namespace {

/// Content of the memory after a power loss.
Retained anything() { return {0x12345678, 0x9ABCDEF0, 1, 1, 0xFFFFFFFF, 77, 1, 2, 3}; }

TEST(Retained, DistinguishesPowerOnFromAReset) {
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

TEST(Retained, ThreeSilentStartsInARowExhaustTheBootAttempts) {
  Retained retained;
  note_reset(retained);  // power on
  for (int start = 0; start < Retained::kMaxBootAttempts; ++start) {
    EXPECT_FALSE(boot_attempts_exhausted(retained)) << start;
    note_start(retained);
    note_reset(retained);  // the watchdog's
  }
  EXPECT_TRUE(boot_attempts_exhausted(retained));
  note_start(retained);
  confirm_start(retained);  // of the fallback image
  note_reset(retained);
  EXPECT_TRUE(boot_attempts_exhausted(retained));
  announce_reset(retained, wire::ResetCause::kCommand, true);
  note_reset(retained);
  EXPECT_TRUE(boot_attempts_exhausted(retained))
      << "the loader that was asked for must not take the silent one for good";
  reset_boot_attempts(retained);
  EXPECT_FALSE(boot_attempts_exhausted(retained));
}

TEST(Retained, AStartThatIsConfirmedIsNoTry) {
  Retained retained;
  note_reset(retained);
  for (int start = 0; start < 3 * Retained::kMaxBootAttempts; ++start) {
    note_start(retained);
    if (start % 2 == 0) confirm_start(retained);
    note_reset(retained);
    EXPECT_FALSE(boot_attempts_exhausted(retained));
  }
}

}  // namespace
}  // namespace pharos::boot
