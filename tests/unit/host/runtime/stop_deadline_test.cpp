// SPDX-License-Identifier: Apache-2.0
#include "host/runtime/stop_deadline.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>

#include "host/runtime/signals.hpp"

namespace pharos::host {
namespace {

constexpr std::chrono::milliseconds kLimit{30};

[[noreturn]] void hang() {
  while (true) ::pause();
}

class StopDeadlineDeath : public ::testing::Test {
 protected:
  StopDeadlineDeath() { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
};

TEST_F(StopDeadlineDeath, EndsAProcessWhoseLoopHangsWhenTheSignalComes) {
  EXPECT_EXIT(
      {
        const Signals signals{SIGTERM};
        const StopDeadline deadline({SIGTERM}, kLimit);
        ::kill(::getpid(), SIGTERM);
        hang();
      },
      ::testing::ExitedWithCode(1), "");
}

TEST_F(StopDeadlineDeath, EndsAProcessThatTookTheSignalAndHangsAfterwards) {
  EXPECT_EXIT(
      {
        StopDeadline deadline({SIGTERM}, kLimit);
        deadline.set_exit_code(7);
        deadline.begin();
        hang();
      },
      ::testing::ExitedWithCode(7), "");
}

TEST_F(StopDeadlineDeath, LeavesAProcessAloneThatIsNotToldToStopOrHasStopped) {
  EXPECT_EXIT(
      {
        { StopDeadline stopped({SIGTERM}, kLimit); }
        {
          StopDeadline stopped({SIGTERM}, kLimit);
          stopped.begin();
        }
        ::usleep(3 * 1000 * static_cast<useconds_t>(kLimit.count()));
        ::_exit(3);
      },
      ::testing::ExitedWithCode(3), "");
}

}  // namespace
}  // namespace pharos::host
