// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "unit/boot/host.hpp"

namespace pharos::boot::test {
namespace {

Bytes slot_bytes(const VirtualTarget& target, std::size_t slot) {
  const auto first = target.machine.flash.bytes.begin() + ModelBoard::slot_offset(slot);
  return {first, first + ModelBoard::kSlotBytes};
}

bool runs(const VirtualTarget& target, const Bytes& image) {
  const Bytes body = body_of(image);
  return target.runs_application() && std::equal(body.begin(), body.end(), target.machine.memory.begin());
}

class Loader : public ::testing::Test {
 protected:
  VirtualTarget target;
  Host host{target};
  const Bytes old_image = make_image(1, {.version = {1, 2, 3}});
  const Bytes new_image = make_image(2, {.body_bytes = 3000, .version = {1, 3, 0}});
};

TEST_F(Loader, StaysAndSaysHelloOnceASecondWhereThereIsNoImage) {
  target.power_on();
  for (int second = 0; second < 100; ++second) {
    const auto hello = host.receive<wire::Hello>(kTicksPerSecond * 11 / 10);
    ASSERT_TRUE(hello);
    EXPECT_EQ(hello->role, wire::Role::kLoader);
    EXPECT_EQ(hello->reset_cause, wire::ResetCause::kPowerOn);
    EXPECT_EQ(hello->board.view(), "model");
    EXPECT_EQ(hello->tick_rate_hz, 50'000'000u);
    EXPECT_EQ(hello->start_count, 1);
    EXPECT_EQ(hello->firmware_major + hello->firmware_minor + hello->firmware_patch, 0);
  }
  EXPECT_EQ(target.loaded(), nullptr);
}

TEST_F(Loader, WritesAnImageAndStartsItAtEveryReset) {
  target.power_on();
  ASSERT_TRUE(host.flash(old_image));
  target.run(kTicksPerSecond);
  EXPECT_TRUE(runs(target, old_image));
  std::ranges::fill(target.machine.memory, 0);
  target.power_off();
  target.power_on();
  target.run(kTicksPerSecond);
  EXPECT_TRUE(runs(target, old_image));
}

TEST_F(Loader, ReportsTheSlotItWillWriteAndTheVersionItWouldStart) {
  start_with(target, host, old_image);
  ASSERT_TRUE(target.runs_application());
  ASSERT_TRUE(host.ask(wire::Command{wire::CommandCode::kEnterLoader, 0}).ack);
  host.send(wire::LoaderQuery{});
  const auto hello = host.receive<wire::Hello>();
  const auto info = host.receive<wire::LoaderInfo>();
  ASSERT_TRUE(hello && info);
  EXPECT_EQ(hello->role, wire::Role::kLoader);
  EXPECT_EQ(hello->reset_cause, wire::ResetCause::kCommand);
  EXPECT_EQ(hello->firmware_major, 1);
  EXPECT_EQ(hello->firmware_minor, 2);
  EXPECT_EQ(hello->firmware_patch, 3);
  EXPECT_EQ(info->loader_version, kLoaderVersion);
  EXPECT_EQ(info->block_bytes, boot_image::kPageBytes);
  EXPECT_EQ(info->slot_offset, ModelBoard::slot_offset(1));
  EXPECT_EQ(info->capacity_bytes, ModelBoard::kSlotBytes);
  EXPECT_EQ(info->board.view(), "model");
}

TEST_F(Loader, TakesTurnsWithTheSlotsAndTouchesNeitherTheGoodOneNorItsFallback) {
  start_with(target, host, old_image);
  std::vector<std::size_t> written;
  for (unsigned round = 0; round < 7; ++round) {
    std::array<Bytes, boot_image::kSlots> before;
    for (std::size_t slot = 0; slot < before.size(); ++slot) before[slot] = slot_bytes(target, slot);
    const Bytes image = make_image(10 + round);
    ASSERT_TRUE(host.flash(image));
    target.run(kTicksPerSecond);
    EXPECT_TRUE(runs(target, image));
    for (std::size_t slot = 0; slot < before.size(); ++slot) {
      if (slot_bytes(target, slot) != before[slot]) written.push_back(slot);
    }
  }
  ASSERT_EQ(written.size(), 7u);
  for (std::size_t i = 2; i < written.size(); ++i) {
    EXPECT_NE(written[i], written[i - 1]);
    EXPECT_NE(written[i], written[i - 2]);
  }
}

TEST_F(Loader, WritesOverTheImageThatStaysSilent) {
  target.silent_patch = 7;
  start_with(target, host, old_image);
  ASSERT_TRUE(host.flash(make_image(3, {.version = {1, 4, 7}})));
  for (int reset = 0; reset <= Retained::kMaxBootAttempts; ++reset) {
    target.run(kTicksPerSecond);
    target.reset();
  }
  target.run(kTicksPerSecond);
  ASSERT_TRUE(runs(target, old_image));
  // The good one is the fallback of the next, which is silent too.
  ASSERT_TRUE(host.flash(make_image(4, {.version = {1, 5, 7}})));
  for (int reset = 0; reset <= Retained::kMaxBootAttempts; ++reset) {
    target.run(kTicksPerSecond);
    target.reset();
  }
  target.run(kTicksPerSecond);
  EXPECT_TRUE(runs(target, old_image));
}

TEST_F(Loader, FallsBackToTheOlderImageWhenTheNewerOneRotted) {
  start_with(target, host, old_image);
  ASSERT_TRUE(host.flash(new_image));
  target.power_off();
  target.machine.flash.bytes[ModelBoard::slot_offset(1) + 2000] ^= 0x10;
  target.power_on();
  target.run(kTicksPerSecond);
  EXPECT_TRUE(runs(target, old_image));
  // The next image overwrites the corrupt one, and is newer.
  const Bytes before = slot_bytes(target, 2);
  ASSERT_TRUE(host.flash(new_image));
  target.run(kTicksPerSecond);
  EXPECT_TRUE(runs(target, new_image));
  EXPECT_EQ(slot_bytes(target, 2), before);
}

TEST_F(Loader, RefusesWhatCannotRunHere) {
  start_with(target, host, old_image);
  ASSERT_TRUE(host.enter());
  EXPECT_EQ(host.begin(new_image, "other").nak, wire::NakReason::kWrongBoard);
  EXPECT_EQ(host.begin(Bytes(boot_image::kPageBytes)).nak, wire::NakReason::kBadPayload);
  const Reply large = host.begin(Bytes(ModelBoard::kSlotBytes + 4));
  EXPECT_EQ(large.nak, wire::NakReason::kTooLarge);
  EXPECT_EQ(large.nak_value, ModelBoard::kSlotBytes);

  const auto refused_head = [&](const Bytes& image) {
    EXPECT_TRUE(host.begin(image).ack);
    const Reply first = host.data(image, 0);
    const Reply then = host.data(image, boot_image::kPageBytes);
    return first.nak == wire::NakReason::kBadPayload && then.nak == wire::NakReason::kOutOfOrder &&
           then.nak_value == wire::kNothingBegun;
  };
  EXPECT_TRUE(refused_head(make_image(3, {.board = "other"})));
  EXPECT_TRUE(refused_head(make_image(3, {.load_address = Machine::kMemoryAddress - 4})));
  EXPECT_TRUE(refused_head(make_image(3, {.load_address = Machine::kMemoryAddress + Machine::kMemoryBytes - 1196})));
  EXPECT_TRUE(refused_head(make_image(3, {.load_address = 0xFFFFFF00})));
  Bytes flipped = new_image;
  flipped[30] ^= 1;
  EXPECT_TRUE(refused_head(flipped));
  Bytes longer = new_image;
  longer.resize(longer.size() + 4);
  EXPECT_TRUE(refused_head(longer));
  target.reset();
  target.run(kTicksPerSecond);
  EXPECT_TRUE(runs(target, old_image));
}

TEST_F(Loader, EveryRequestMayComeTwice) {
  start_with(target, host, old_image);
  ASSERT_TRUE(host.enter());
  ASSERT_EQ(host.begin(new_image).ack, 0u);
  EXPECT_EQ(host.begin(new_image).ack, 0u);
  for (std::size_t offset = 0; offset < new_image.size(); offset += boot_image::kPageBytes) {
    const auto next = static_cast<std::uint32_t>(std::min(offset + boot_image::kPageBytes, new_image.size()));
    EXPECT_EQ(host.data(new_image, offset).ack, next);
    EXPECT_EQ(host.data(new_image, offset).ack, next);
    EXPECT_EQ(host.data(new_image, 0).ack, next);
  }
  EXPECT_EQ(host.ask(wire::LoaderVerify{}).ack, wire::crc32(new_image));
  EXPECT_EQ(host.ask(wire::LoaderVerify{}).ack, wire::crc32(new_image));
  EXPECT_EQ(host.begin(new_image).ack, new_image.size());
  EXPECT_TRUE(host.ask(wire::LoaderStart{}).ack);
  target.run(kTicksPerSecond);
  EXPECT_TRUE(runs(target, new_image));
}

TEST_F(Loader, AsksForTheBlockThatIsMissing) {
  target.power_on();
  ASSERT_TRUE(host.enter());
  EXPECT_EQ(host.data(new_image, 0).nak_value, wire::kNothingBegun);
  EXPECT_EQ(host.ask(wire::LoaderVerify{}).nak_value, wire::kNothingBegun);
  ASSERT_TRUE(host.begin(new_image).ack);
  ASSERT_TRUE(host.data(new_image, 0).ack);
  const Reply early = host.data(new_image, 512);
  EXPECT_EQ(early.nak, wire::NakReason::kOutOfOrder);
  EXPECT_EQ(early.nak_value, 256u);
  EXPECT_EQ(host.data(new_image, 256, 100).nak, wire::NakReason::kBadPayload);
  EXPECT_EQ(host.ask(wire::LoaderVerify{}).nak_value, 256u);
  EXPECT_EQ(host.ask(wire::LoaderStart{}).nak, wire::NakReason::kNotVerified);
  // A host that begins again with the same image gets the offset to continue, one with another image starts at zero.
  EXPECT_EQ(host.begin(new_image).ack, 256u);
  EXPECT_EQ(host.begin(old_image).ack, 0u);
}

TEST_F(Loader, MarksNothingThatDoesNotVerify) {
  start_with(target, host, old_image);
  ASSERT_TRUE(host.enter());
  wire::LoaderBegin begin;
  begin.image_bytes = static_cast<std::uint32_t>(new_image.size());
  begin.image_crc32 = wire::crc32(new_image) ^ 1;
  begin.board = wire::Text<24>("model");
  ASSERT_TRUE(host.ask(begin).ack);
  ASSERT_TRUE(host.all_data(new_image).ack);
  const Reply reply = host.ask(wire::LoaderVerify{});
  EXPECT_EQ(reply.nak, wire::NakReason::kBadCrc);
  EXPECT_EQ(reply.nak_value, wire::crc32(new_image));
  EXPECT_TRUE(host.ask(wire::LoaderStart{}).ack) << "nothing is begun any more, so the good image may start";

  // A body that does not match the header.
  Bytes flipped = new_image;
  flipped[1000] ^= 1;
  ASSERT_TRUE(host.enter());
  ASSERT_TRUE(host.begin(flipped).ack);
  ASSERT_TRUE(host.all_data(flipped).ack);
  EXPECT_EQ(host.ask(wire::LoaderVerify{}).nak, wire::NakReason::kBadPayload);
  target.reset();
  target.run(kTicksPerSecond);
  EXPECT_TRUE(runs(target, old_image));
}

TEST_F(Loader, ReportsThatTheFlashFails) {
  start_with(target, host, old_image);
  ASSERT_TRUE(host.enter());
  target.machine.flash.broken = true;
  EXPECT_EQ(host.begin(new_image).nak, wire::NakReason::kWriteFailed);
  target.machine.flash.broken = false;
  ASSERT_TRUE(host.begin(new_image).ack);
  ASSERT_TRUE(host.data(new_image, 0).ack);
  target.machine.flash.broken = true;
  const Reply reply = host.data(new_image, 256);
  EXPECT_EQ(reply.nak, wire::NakReason::kWriteFailed);
  EXPECT_EQ(reply.nak_value, 256u);
}

TEST_F(Loader, AnswersWhatItDoesNotKnow) {
  target.power_on();
  ASSERT_TRUE(host.enter());
  EXPECT_EQ(host.ask(wire::Command{wire::CommandCode::kReset, 0}).nak, wire::NakReason::kUnsupported);
  EXPECT_EQ(host.ask(wire::LoaderStart{}).nak, wire::NakReason::kNotVerified) << "there is no image";
}

TEST_F(Loader, IsHeardForAFifthOfASecondAfterEveryReset) {
  start_with(target, host, old_image);
  target.hangs = true;
  target.reset();
  target.run(kTicksPerSecond / 10);
  EXPECT_FALSE(target.runs_application());
  host.send(wire::LoaderQuery{});
  target.run(kTicksPerSecond);
  EXPECT_FALSE(target.runs_application());
  EXPECT_TRUE(host.receive<wire::Hello>());

  target.reset();
  target.run(kTicksPerSecond * 21 / 100);
  EXPECT_TRUE(target.runs_application());
}

TEST_F(Loader, GoesBackFromAnImageThatStaysSilent) {
  const Bytes first = make_image(1, {.version = {1, 0, 1}});
  const Bytes silent = make_image(2, {.version = {1, 0, 2}});
  start_with(target, host, first);
  target.silent_patch = 2;
  host.flash(silent);
  target.run(kTicksPerSecond);
  for (int reset = 0; reset < Retained::kMaxBootAttempts; ++reset) {
    ASSERT_TRUE(target.runs_application());
    EXPECT_EQ(target.running().version.patch, 2) << reset;
    target.reset();  // the watchdog's
    target.run(kTicksPerSecond);
  }
  ASSERT_TRUE(target.runs_application());
  EXPECT_EQ(target.running().version.patch, 1);
  target.reset();
  target.run(kTicksPerSecond);
  EXPECT_EQ(target.running().version.patch, 1) << "it does not go to and fro";

  const Bytes third = make_image(3, {.version = {1, 0, 3}});
  ASSERT_TRUE(host.flash(third));
  target.run(kTicksPerSecond);
  EXPECT_EQ(target.running().version.patch, 3) << "over the silent one";
  target.silent_patch = 3;
  for (int reset = 0; reset <= Retained::kMaxBootAttempts; ++reset) {
    target.reset();
    target.run(kTicksPerSecond);
  }
  EXPECT_EQ(target.running().version.patch, 1) << "the good one was kept";
}

TEST_F(Loader, KeepsASilentImageWhereThereIsNoOther) {
  start_with(target, host, old_image);
  target.hangs = true;
  for (int reset = 0; reset < 2 * Retained::kMaxBootAttempts; ++reset) {
    target.reset();
    target.run(kTicksPerSecond);
    ASSERT_TRUE(target.runs_application());
  }
}

TEST_F(Loader, SaysNothingOnItsWayToTheImage) {
  start_with(target, host, old_image);
  target.reset();
  target.machine.from_target.clear();
  while (!target.runs_application()) target.step();
  EXPECT_TRUE(target.machine.from_target.empty());
}

TEST_F(Loader, StartsWhatItHasAfterAMinuteOfSilence) {
  start_with(target, host, old_image);
  ASSERT_TRUE(host.enter());
  ASSERT_TRUE(host.begin(new_image).ack);
  target.run(59 * std::int64_t{kTicksPerSecond});
  EXPECT_FALSE(target.runs_application());
  target.run(2 * kTicksPerSecond);
  EXPECT_TRUE(runs(target, old_image));
}

TEST_F(Loader, FindsFramesInGarbage) {
  start_with(target, host, old_image);
  ASSERT_TRUE(host.enter());
  std::mt19937 random(5);
  Bytes garbage(3000);
  for (std::uint8_t& byte : garbage) byte = static_cast<std::uint8_t>(random());
  target.machine.host_sends(garbage);
  EXPECT_EQ(host.begin(new_image).ack, 0u);
  EXPECT_TRUE(host.all_data(new_image).ack);
}

TEST_F(Loader, LosesNoByteOfAFullWindowWhileFlashIsWritten) {
  target.machine.flash.program_ticks = 5 * kTicksPerSecond / 1000;  // the slowest page of a serial flash
  target.machine.uart_holds = 1;
  target.power_on();
  ASSERT_TRUE(host.enter());
  ASSERT_TRUE(host.begin(new_image).ack);
  ASSERT_TRUE(host.data(new_image, 0).ack);
  ASSERT_TRUE(host.data(new_image, 256).ack);
  for (std::size_t block = 2; block < 2 + wire::kLoaderWindow; ++block) {
    wire::LoaderData data;
    data.offset = static_cast<std::uint32_t>(256 * block);
    for (std::size_t i = 0; i < 256; ++i) data.data.push_back(new_image[data.offset + i]);
    host.send(data);
  }
  for (std::uint32_t block = 2; block < 2 + wire::kLoaderWindow; ++block) {
    const auto ack = host.receive<wire::Ack>();
    ASSERT_TRUE(ack);
    EXPECT_EQ(ack->value, 256 * (block + 1));
  }
  EXPECT_EQ(target.machine.overruns, 0u);
}

}  // namespace
}  // namespace pharos::boot::test
