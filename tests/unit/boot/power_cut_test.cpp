// SPDX-License-Identifier: Apache-2.0
// The guarantee of two slots: after a power loss at any step of any write a complete image starts.
#include <gtest/gtest.h>

#include <algorithm>

#include "unit/boot/host.hpp"

namespace pharos::boot::test {
namespace {

enum class Starts : std::uint8_t { kOld, kNew, kNeither };

/// A clock that is not part of the test.
void set_fast_flash(VirtualTarget& target) {
  target.turn_ticks = kTicksPerSecond / 200;
  target.machine.byte_ticks = 1;
  target.machine.uart_holds = 1 << 20;
}

/// The image started without any request, compared in memory byte by byte.
Starts started_image(VirtualTarget& target, const Bytes& old_image, const Bytes& new_image) {
  std::ranges::fill(target.machine.memory, 0);
  target.power_on();
  target.run(kTicksPerSecond / 2);
  if (!target.runs_application()) return Starts::kNeither;
  const auto holds = [&](const Bytes& image) {
    const Bytes body = body_of(image);
    return std::equal(body.begin(), body.end(), target.machine.memory.begin());
  };
  return holds(old_image) ? Starts::kOld : holds(new_image) ? Starts::kNew : Starts::kNeither;
}

/// Cuts the power at every step of writing new_image over `target`, once each.
void cut_at_every_step(unsigned seed, const Bytes& before, const Bytes& old_image, const Bytes& new_image) {
  std::uint64_t steps = UINT64_MAX;  // of an undisturbed flashing
  std::uint64_t olds = 0;
  std::uint64_t news = 0;
  for (std::uint64_t cut = 0; cut < steps; ++cut) {
    VirtualTarget target;
    set_fast_flash(target);
    target.machine.flash.bytes = before;
    target.machine.flash.random.seed(seed + static_cast<unsigned>(cut));
    Host host(target);
    if (steps == UINT64_MAX) {
      target.power_on();
      ASSERT_TRUE(host.flash(new_image));
      steps = target.machine.flash.steps_done;
      target.power_off();
      target.machine.flash.bytes = before;
    }
    target.power_on();
    target.run(kTicksPerSecond / 2);
    ASSERT_TRUE(target.runs_application());
    target.machine.flash.steps_left = cut;
    bool verified = false;
    if (host.enter() && host.begin(new_image).ack && host.all_data(new_image).ack) {
      verified = host.ask(wire::LoaderVerify{}, kTicksPerSecond).ack.has_value();
    }
    ASSERT_FALSE(verified) << "cut " << cut << " came too late";
    for (int again = 0; again < 2; ++again) {  // half-written bits may be read differently the next time
      const Starts starts = started_image(target, old_image, new_image);
      ASSERT_NE(starts, Starts::kNeither) << "cut " << cut << " of " << steps;
      (starts == Starts::kOld ? olds : news) += 1;
      target.power_off();
    }
    if (cut % 50 == 0) {
      target.power_on();
      ASSERT_TRUE(host.flash(new_image)) << "after cut " << cut;
      ASSERT_EQ(started_image(target, old_image, new_image), Starts::kNew);
    }
  }
  EXPECT_GT(olds, 2 * steps - 200) << "all but cuts within the mark";
}

TEST(PowerCut, AtAnyStepLeavesAWholeImage) {
  const Bytes first = make_image(1, {.body_bytes = 600});
  const Bytes second = make_image(2, {.body_bytes = 500});
  const Bytes third = make_image(3, {.body_bytes = 700});
  const Bytes fourth = make_image(4, {.body_bytes = 560});
  VirtualTarget target;
  Host host(target);
  start_with(target, host, first);
  const Bytes with_one_slot = target.machine.flash.bytes;
  ASSERT_TRUE(host.flash(second));
  target.run(kTicksPerSecond);
  ASSERT_TRUE(host.flash(third));
  const Bytes with_all_slots = target.machine.flash.bytes;
  cut_at_every_step(100, with_one_slot, first, second);
  cut_at_every_step(200, with_all_slots, third, fourth);
}

TEST(PowerCut, OverAnInterruptedFlashingLeavesAWholeImage) {
  const Bytes good = make_image(1, {.body_bytes = 600});
  const Bytes torn = make_image(2, {.body_bytes = 500});
  const Bytes next = make_image(3, {.body_bytes = 400});
  VirtualTarget target;
  Host host(target);
  start_with(target, host, good);
  target.machine.flash.steps_left = 3 + 250;  // in the middle of the body
  ASSERT_FALSE(host.flash(torn));
  cut_at_every_step(300, target.machine.flash.bytes, good, next);
}

TEST(PowerCut, OverANewerImageThatRottedLeavesTheOlderOne) {
  const Bytes good = make_image(1, {.body_bytes = 600});
  const Bytes rotten = make_image(2, {.body_bytes = 500});
  const Bytes next = make_image(3, {.body_bytes = 400});
  VirtualTarget target;
  Host host(target);
  start_with(target, host, good);
  ASSERT_TRUE(host.flash(rotten));
  target.machine.flash.bytes[ModelBoard::slot_offset(1) + 400] ^= 1;
  cut_at_every_step(400, target.machine.flash.bytes, good, next);
}

TEST(PowerCut, WhileTheFirstImageIsWrittenLeavesALoaderThatTakesIt) {
  const Bytes image = make_image(1, {.body_bytes = 300});
  for (std::uint64_t cut = 0; cut < 6 + 300 + 72; cut += 7) {
    VirtualTarget target;
    set_fast_flash(target);
    Host host(target);
    target.power_on();
    target.machine.flash.steps_left = cut;
    ASSERT_FALSE(host.flash(image)) << cut;
    target.power_on();
    ASSERT_TRUE(host.flash(image)) << cut;
    target.run(kTicksPerSecond);
    ASSERT_TRUE(target.runs_application()) << cut;
  }
}

}  // namespace
}  // namespace pharos::boot::test
