// SPDX-License-Identifier: Apache-2.0
// `pharos flash` with the real loader, in virtual time.
#include "tools/flash/flasher.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "host/support/input_error.hpp"
#include "tests/support/error_of.hpp"
#include "unit/boot/host.hpp"
#include "unit/flash/virtual_flash_line.hpp"

namespace pharos::tools::test {
namespace {

using boot::test::Bytes;
using boot::test::make_image;
using boot::test::ModelBoard;
using ::testing::HasSubstr;

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kMillisecond_ticks = kTicksPerSecond / 1000;

BootImageFile file_of(const Bytes& bytes) { return {bytes, *boot_image::check_image(bytes)}; }

class Flash : public ::testing::Test {
 protected:
  void SetUp() override {
    boot::test::Host host(target);
    boot::test::start_with(target, host, old_image.bytes);
    ASSERT_TRUE(target.runs_application());
  }

  FlashResult flash(const BootImageFile& image) {
    Flasher flasher(line, reports, options);
    return flasher.flash(image);
  }
  /// The error message; empty where there is none.
  std::string error_of(const BootImageFile& image) {
    return pharos::test::error_of([&] { flash(image); });
  }
  bool runs(const BootImageFile& image) const {
    const Bytes body = boot::test::body_of(image.bytes);
    return target.runs_application() && std::equal(body.begin(), body.end(), target.machine.memory.begin());
  }
  void expect_old_runs_after_power_cycle() {
    target.power_off();
    target.power_on();
    target.run(kTicksPerSecond);
    EXPECT_TRUE(runs(old_image));
  }

  boot::test::VirtualTarget target;
  VirtualFlashLine line{target};
  std::string notes;
  std::vector<std::size_t> progress;
  bool allow_older = false;
  int asked = 0;
  FlashReports reports{.note = [this](const std::string& text) { notes += text + '\n'; },
                       .progress = [this](std::size_t bytes) { progress.push_back(bytes); },
                       .allow_older =
                           [this](const boot_image::Version&) {
                             ++asked;
                             return allow_older;
                           }};
  FlashOptions options{.wait_ns = 5 * kSecond};
  const BootImageFile old_image = file_of(make_image(1, {.version = {1, 2, 3}}));
  const BootImageFile new_image = file_of(make_image(2, {.body_bytes = 5000, .version = {1, 3, 0}}));
};

TEST_F(Flash, WritesAnImageAndNamesWhatRunsAfterwards) {
  const FlashResult flashed = flash(new_image);
  EXPECT_TRUE(runs(new_image));
  EXPECT_EQ(flashed.before, (boot_image::Version{1, 2, 3}));
  EXPECT_EQ(flashed.running.role, wire::Role::kDecoder);
  EXPECT_EQ(flashed.running.firmware_minor, 3);
  EXPECT_EQ(flashed.running.board.view(), "model");
  EXPECT_EQ(flashed.slot_offset, ModelBoard::slot_offset(1));
  ASSERT_FALSE(progress.empty());
  EXPECT_TRUE(std::ranges::is_sorted(progress));
  EXPECT_EQ(progress.back(), new_image.bytes.size());
  EXPECT_EQ(notes, "");
}

TEST_F(Flash, FindsATargetThatIsInItsLoaderAlready) {
  boot::test::Host host(target);
  ASSERT_TRUE(host.enter());
  const FlashResult flashed = flash(new_image);
  EXPECT_EQ(flashed.before, (boot_image::Version{1, 2, 3}));
  EXPECT_TRUE(runs(new_image));
}

TEST_F(Flash, FindsATargetInTheMiddleOfAFrame) {
  const Bytes half{0x00, 0x30, 1, 2, 3, 4, 5};
  target.machine.host_sends(half);
  target.machine.from_target.push_front({0, 0x55});
  flash(new_image);
  EXPECT_TRUE(runs(new_image));
}

TEST_F(Flash, WritesTheFirstImageOfAnEmptyTarget) {
  std::ranges::fill(target.machine.flash.bytes, 0xFF);
  target.power_off();
  target.power_on();
  const FlashResult flashed = flash(new_image);
  EXPECT_FALSE(flashed.before);
  EXPECT_TRUE(runs(new_image));
}

TEST_F(Flash, ReachesATargetThatHangsWhenItIsSwitchedOffAndOn) {
  target.hangs = true;
  const std::int64_t switched = target.machine.now + 4 * kTicksPerSecond;
  line.meanwhile = [&] {
    if (!target.hangs || target.machine.now < switched) return;
    target.power_off();
    target.power_on();
    target.hangs = false;
  };
  flash(new_image);
  EXPECT_THAT(notes, HasSubstr("switch the target off and on"));
  EXPECT_TRUE(runs(new_image));
}

TEST_F(Flash, GivesUpOnASilentTargetAndSaysWhatToDo) {
  target.power_off();
  const std::int64_t start = line.now_ns();
  EXPECT_THAT(error_of(new_image), HasSubstr("no answer from the target"));
  EXPECT_LT(line.now_ns() - start, 6 * kSecond);
}

TEST_F(Flash, ReportsAWrongSpeed) {
  line.to_host = [](std::uint8_t byte) { return static_cast<std::uint8_t>(byte ^ 0x55); };
  EXPECT_THAT(error_of(new_image), HasSubstr("baud"));
}

TEST_F(Flash, RefusesAnImageForAnotherBoardAndLeavesTheProgramRunning) {
  EXPECT_THAT(error_of(file_of(make_image(3, {.board = "ep4ce10"}))), HasSubstr("for the board 'ep4ce10'"));
  EXPECT_TRUE(runs(old_image));
  boot::test::Host host(target);
  ASSERT_TRUE(host.enter());
  EXPECT_THAT(error_of(file_of(make_image(3, {.board = "ep4ce10"}))), HasSubstr("the target is a 'model'"));
}

TEST_F(Flash, RefusesAnImageLargerThanTheSlotAndStartsWhatWasThere) {
  EXPECT_THAT(error_of(file_of(make_image(3, {.body_bytes = ModelBoard::kSlotBytes, .version = {2, 0, 0}}))),
              HasSubstr("the target's slot holds 131072"));
  target.run(kTicksPerSecond);
  EXPECT_TRUE(runs(old_image));
}

TEST_F(Flash, AsksBeforeItWritesAnOlderImage) {
  const BootImageFile older = file_of(make_image(4, {.version = {1, 2, 2}}));
  EXPECT_THAT(error_of(older), HasSubstr("version 1.2.2, older than 1.2.3"));
  EXPECT_EQ(asked, 1);
  EXPECT_TRUE(runs(old_image));
  allow_older = true;
  flash(older);
  EXPECT_EQ(asked, 2) << "once, though the version is told twice";
  EXPECT_TRUE(runs(older));
  flash(older);
  EXPECT_EQ(asked, 2) << "the same version again is not older";
}

TEST_F(Flash, RefusesAnImageThatCannotRunThere) {
  EXPECT_THAT(error_of(file_of(make_image(5, {.version = {2, 0, 0}, .load_address = 0x1000}))),
              HasSubstr("refuses the image"));
  expect_old_runs_after_power_cycle();
}

TEST_F(Flash, TellsEachRefusalOfOrigin) {
  const auto newer = [](bool is_signed) { return make_image(6, {.version = {2, 0, 0}, .is_signed = is_signed}); };
  EXPECT_THAT(error_of(file_of(newer(false))), HasSubstr("is not signed, and the target's development jumper"));
  target.run(kTicksPerSecond);
  EXPECT_TRUE(runs(old_image)) << "it was started again";
  auto forged = newer(true);
  forged[120] ^= 1;
  EXPECT_THAT(error_of(file_of(forged)), HasSubstr("signature is not of the key"));
  target.machine.has_verifier = false;
  EXPECT_THAT(error_of(file_of(newer(true))), HasSubstr("verifier of signatures is missing"));
  target.machine.has_verifier = true;
  flash(file_of(newer(true)));
  flash(file_of(make_image(7, {.version = {2, 0, 1}})));
  allow_older = true;
  EXPECT_THAT(error_of(old_image), HasSubstr("older than 2.0.0, the oldest version"));
}

TEST_F(Flash, ReportsThatTheFlashIsBroken) {
  line.meanwhile = [&] { target.machine.flash.broken = !target.runs_application() && !progress.empty(); };
  EXPECT_THAT(error_of(new_image), HasSubstr("flash cannot be written"));
  line.meanwhile = [] {};
  target.machine.flash.broken = false;
  expect_old_runs_after_power_cycle();
}

TEST_F(Flash, BeginsAnewWhenTheTargetIsResetOnTheWay) {
  bool done = false;
  line.meanwhile = [&] {
    if (done || progress.empty() || progress.back() < 2000) return;
    done = true;
    target.reset();
  };
  flash(new_image);
  EXPECT_THAT(notes, HasSubstr("beginning anew"));
  EXPECT_TRUE(runs(new_image));
}

TEST_F(Flash, GivesUpWhenThePowerGoesAndTheOldImageIsStillThere) {
  line.meanwhile = [&] {
    if (!progress.empty() && progress.back() > 3000 && target.powered) target.power_off();
  };
  EXPECT_THAT(error_of(new_image), HasSubstr("fell silent at byte"));
  line.meanwhile = [] {};
  expect_old_runs_after_power_cycle();
  flash(new_image);
  EXPECT_TRUE(runs(new_image));
}

TEST_F(Flash, GoesOnWhereABrokenRunStopped) {
  bool cut = false;
  const auto lost_after = [&](std::uint8_t byte) -> std::optional<std::uint8_t> {
    cut = cut || (!progress.empty() && progress.back() > 3000);
    if (cut) return std::nullopt;
    return byte;
  };
  line.to_target = lost_after;
  EXPECT_THAT(error_of(new_image), HasSubstr("run this again"));
  line.to_target = [](std::uint8_t byte) { return byte; };
  flash(new_image);
  EXPECT_THAT(notes, HasSubstr("going on at byte 3"));
  EXPECT_TRUE(runs(new_image));
}

/// A line that loses and corrupts bytes: each run ends either with the new image running, or with an error and the old
/// one.
TEST_F(Flash, OverALineThatLosesBytesSucceedsOrFailsCleanly) {
  int succeeded = 0;
  for (unsigned seed = 0; seed < 30; ++seed) {
    std::mt19937 random(seed);
    const unsigned one_in = 100u << (seed % 6);
    const auto fault = [&](std::uint8_t byte) -> std::optional<std::uint8_t> {
      const auto rng = static_cast<std::uint32_t>(random());
      if (rng % one_in != 0) return byte;
      if ((rng >> 20) % 2 == 0) return std::nullopt;
      return static_cast<std::uint8_t>(byte ^ (1u << (rng >> 24) % 8));
    };
    line.to_target = line.to_host = fault;
    const BootImageFile image =
        file_of(make_image(100 + seed, {.body_bytes = 5000, .version = {2, 0, static_cast<std::uint8_t>(seed)}}));
    const Bytes before = target.machine.memory;
    const std::string error = error_of(image);
    target.power_off();
    target.power_on();
    target.run(kTicksPerSecond);
    ASSERT_TRUE(target.runs_application());
    if (error.empty()) {
      ++succeeded;
      EXPECT_TRUE(runs(image)) << seed;
    } else {
      const bool whole =
          runs(image) || std::equal(before.begin(), before.begin() + 1000, target.machine.memory.begin());
      EXPECT_TRUE(whole) << seed << ": " << error;
    }
  }
  EXPECT_GE(succeeded, 25) << "one byte in 400 or fewer must not keep an image out";
}

/// The budget: 64 KiB in 3 s at 460,800 baud besides erasing, and two thirds of the line's capacity used, with any
/// adapter and flash.
class Speed : public Flash, public ::testing::WithParamInterface<std::pair<std::int64_t, std::int64_t>> {};

TEST_P(Speed, FlashesWithinItsBudget) {
  line.adapter_ticks = GetParam().first;
  target.machine.flash.program_ticks = GetParam().second;
  const BootImageFile image = file_of(make_image(7, {.body_bytes = 64 * 1024, .version = {2, 0, 0}}));
  const FlashResult flashed = flash(image);
  const double seconds = static_cast<double>(flashed.line_ns) * 1e-9;
  const double used = static_cast<double>(image.bytes.size()) * 10 / 460'800 / seconds;
  RecordProperty("seconds", std::to_string(seconds));
  RecordProperty("line_used", std::to_string(used));
  std::printf("64 KiB, adapter %.0f ms, page %.1f ms: %.2f s, payload is %.0f %% of the line\n",
              static_cast<double>(GetParam().first) / kMillisecond_ticks,
              static_cast<double>(GetParam().second) / kMillisecond_ticks, seconds, 100 * used);
  EXPECT_LE(seconds, 3.0);
  EXPECT_GE(used, 0.65);
  EXPECT_EQ(flashed.blocks_sent, (image.bytes.size() + 255) / 256) << "none twice";
  EXPECT_EQ(target.machine.overruns, 0u);
}

INSTANTIATE_TEST_SUITE_P(AdapterAndFlash, Speed,
                         ::testing::Values(std::pair{std::int64_t{0}, std::int64_t{0}},
                                           std::pair{std::int64_t{0}, 5 * kMillisecond_ticks},
                                           std::pair{16 * kMillisecond_ticks, 3 * kMillisecond_ticks / 2}));

}  // namespace
}  // namespace pharos::tools::test
