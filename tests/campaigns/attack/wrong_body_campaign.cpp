// SPDX-License-Identifier: Apache-2.0
// The board of another body on the port of a target whose configuration names its own.
#include "campaigns/attack/attacked_lighthouse.hpp"

namespace pharos::host {
namespace {

using AttackedIdentity = AttackedLighthouse;

TEST_F(AttackedIdentity, AnotherBodysBoard) {
  const auto seconds = static_cast<double>(campaign_size("PHAROS_ATTACK_SECONDS", 10));
  start("[target.identity]\nsensors = 5\n");  // the board says six
  std::size_t messages = 0;
  play_for(1.0);  // before it says who it is
  line.write(target.hello("another body"));
  play_for(seconds);
  daemon.wait([] { return false; }, 0.5);
  messages = daemon.poses().size();
  const auto valid = static_cast<std::int64_t>(daemon.valid_poses());
  ASSERT_GT(messages, 0u) << daemon.process().text();
  EXPECT_EQ(valid, 0);
  ASSERT_NE(daemon.source(), nullptr);
  EXPECT_EQ(daemon.source()->state, "error");
  EXPECT_EQ(daemon.poses().back().status, "refused_wrong_target");
  add_row({"another body's board",
           std::to_string(sweeps_sent()) + " sweeps, " + std::to_string(messages) +
               " messages refused_wrong_target, state " + daemon.source()->state,
           valid, std::nullopt, memory()});
}

}  // namespace
}  // namespace pharos::host
