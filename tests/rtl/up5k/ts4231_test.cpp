// SPDX-License-Identifier: Apache-2.0
// The start of TS4231 receivers, against a model of the part as its maker's library sees it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "rtl/up5k/ts4231_device.hpp"

namespace pharos::rtl {
namespace {

constexpr std::size_t kReceivers = 4;
constexpr std::uint32_t kConfiguration = 0x392B;
constexpr int kTicksPerMicrosecond = 16;

/// A receiver: after power on it shows light on D only; E and D then carry a bus, until it watches and shows light as a
/// low E.
class Receiver {
 public:
  enum class State { kFresh, kSleep, kBus, kWatch };

  State state = State::kFresh;
  std::uint32_t configuration = 0;
  bool broken = false;  // stores a wrong bit

  bool light = false;

  /// Levels of both lines with what the other side drives.
  bool e(bool driven, bool level) const {
    return driven ? level : state != State::kFresh && !(state == State::kWatch && light) && state != State::kSleep;
  }
  bool d(bool driven, bool level) const {
    if (driven) return level;
    if (reading_) return out_;
    if (state == State::kFresh) return light;
    return state == State::kBus || state == State::kSleep;
  }

  /// A tick's levels of both lines.
  void see(bool e_now, bool d_now, bool driven) {
    const bool e_rose = e_now && !e_, e_fell = !e_now && e_, d_rose = d_now && !d_, d_fell = !d_now && d_;
    e_ = e_now;
    d_ = d_now;
    if (!driven && state != State::kBus) return;
    switch (state) {
      case State::kFresh:
        if (had_light_ && !light && e_rose) state = State::kSleep;
        break;
      case State::kSleep:
        if (e_now && d_rose) state = State::kBus;
        break;
      case State::kWatch:
        if (e_fell) state = State::kSleep;
        break;
      case State::kBus:
        bus(e_now, e_rose, e_fell, d_now, d_rose, d_fell);
        break;
    }
  }
  void note_light() { had_light_ = had_light_ || light; }

 private:
  // Start: D falls while E is high. Then a direction and 14 bits, taken as E rises, shown from the rise on. Stop: D
  // rises while E is high.
  void bus(bool e_now, bool e_rose, bool e_fell, bool d_now, bool d_rose, bool d_fell) {
    const bool marks = e_now && !e_rose && !reading_;  // else D is this side's own
    if (marks && d_fell) {
      open_ = true;
      bits_ = 0;
      return;
    }
    if (marks && d_rose) {
      if (open_ && bits_ >= 15 && !reads_) configuration = shifted_ & 0x3FFF;
      open_ = reading_ = false;
      return;
    }
    if (!open_) {
      if (!e_now && d_fell) state = State::kWatch;  // E low first, then D
      return;
    }
    if (e_rose) {
      if (bits_ == 0) {
        reads_ = d_now;
        shifted_ = 0;
      } else if (!reads_) {
        if (bits_ <= 14) shifted_ = shifted_ << 1 | (d_now ? 1 : 0);
        if (broken && bits_ == 7) shifted_ ^= 1;
      } else if (bits_ <= 14) {
        out_ = (configuration >> (14 - bits_) & 1) != 0;
      }
      ++bits_;
    }
    if (e_fell && reads_ && bits_ == 1) reading_ = true;
    if (reading_ && bits_ > 14 && e_fell) reading_ = false;
  }

  bool e_ = false, d_ = false;
  bool had_light_ = false;
  bool open_ = false, reads_ = false, reading_ = false, out_ = false;
  int bits_ = 0;
  std::uint32_t shifted_ = 0;
};

class Start : public testing::Test {
 protected:
  void SetUp() override {
    for (int i = 0; i < 8; ++i) outputs = device->tick(0, 0, true);
  }
  void run(int microseconds) {
    for (int i = 0; i < microseconds * kTicksPerMicrosecond; ++i) {
      std::uint32_t e_levels = 0, d_levels = 0;
      for (std::size_t r = 0; r < kReceivers; ++r) {
        const bool e_driven = (outputs.e_driven >> r & 1) != 0, d_driven = (outputs.d_driven >> r & 1) != 0;
        receiver[r].note_light();
        const bool e = receiver[r].e(e_driven, outputs.e_out), d = receiver[r].d(d_driven, outputs.d_out);
        receiver[r].see(e, d, e_driven || d_driven);
        e_levels |= std::uint32_t{e} << r;
        d_levels |= std::uint32_t{d} << r;
      }
      const StartOutputs before = outputs;
      outputs = device->tick(e_levels, d_levels, false);
      shortest = (before.e_out != outputs.e_out || before.d_out != outputs.d_out) ? std::min(shortest, held) : shortest;
      held = (before.e_out != outputs.e_out || before.d_out != outputs.d_out) ? 1 : held + 1;
    }
  }
  void flash(std::size_t r) {
    receiver[r].light = true;
    run(80);
    receiver[r].light = false;
    run(20);
  }
  std::unique_ptr<StartDevice> device = make_start_device();
  StartOutputs outputs;
  std::array<Receiver, kReceivers> receiver;
  int held = 0;
  int shortest = 1 << 30;
};

TEST_F(Start, NothingIsDrivenBeforeLight) {
  run(10'000);
  EXPECT_EQ(outputs.e_driven | outputs.d_driven, 0u);
  EXPECT_EQ(outputs.ready, 0u);
}

TEST_F(Start, AReceiverIsConfiguredAfterItsFirstLight) {
  flash(2);
  run(2'000);
  EXPECT_EQ(receiver[2].configuration, kConfiguration);
  EXPECT_EQ(receiver[2].state, Receiver::State::kWatch);
  EXPECT_EQ(outputs.ready, 0b0100u);
  EXPECT_EQ(outputs.e_driven | outputs.d_driven, 0u);
  EXPECT_GE(shortest, kTicksPerMicrosecond) << "the maker waits a microsecond between changes";
}

TEST_F(Start, AllThatSawTheSameFlashAreConfiguredOneAfterTheOther) {
  for (Receiver& each : receiver) each.light = true;
  run(80);
  for (Receiver& each : receiver) each.light = false;
  run(4'000);
  EXPECT_EQ(outputs.ready, 0b1111u);
  for (const Receiver& each : receiver) EXPECT_EQ(each.configuration, kConfiguration);
}

TEST_F(Start, AReceiverThatAnswersSomethingElseIsTriedAgain) {
  receiver[0].broken = true;
  flash(0);
  run(2'000);
  EXPECT_EQ(outputs.ready, 0u);
  receiver[0].broken = false;
  run(400'000);  // D stays high on its idle bus
  EXPECT_EQ(outputs.ready, 0b0001u);
  EXPECT_EQ(receiver[0].configuration, kConfiguration);
}

TEST_F(Start, AReceiverThatWatchesIsLeftAlone) {
  flash(1);
  run(2'000);
  ASSERT_EQ(outputs.ready, 0b0010u);
  for (int i = 0; i < 20; ++i) {
    flash(1);
    EXPECT_EQ(outputs.e_driven | outputs.d_driven, 0u);
  }
  EXPECT_EQ(outputs.ready, 0b0010u);
}

}  // namespace
}  // namespace pharos::rtl
