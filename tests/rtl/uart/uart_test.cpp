// SPDX-License-Identifier: Apache-2.0
// The UART (firmware/rtl/soc/soc_uart.v): both FIFOs are in one block of RAM, so what goes out must not meet what comes
// in.
#include <gtest/gtest.h>

#include <deque>
#include <random>
#include <vector>

#include "rtl/chip/uart_line.hpp"
#include "rtl/uart/uart_device.hpp"

namespace pharos::rtl {
namespace {

constexpr std::uint32_t kData = 0, kLineControl = 3, kStatus = 5;
constexpr std::uint8_t kSome = 0x01, kOverrun = 0x02, kEmpty = 0x20, kIdle = 0x40;
constexpr std::size_t kFifo = 128;
constexpr std::int64_t kByte_ticks = 1'100;  // ten bits of 108.5 ticks, and some

class Uart : public testing::Test {
 protected:
  Uart() {
    inputs_.reset = true;
    tick();
    inputs_.reset = false;
    write(kLineControl, 0x83);
    write(kData, 1736 & 0xFF);
    write(1, 1736 >> 8);
    write(kLineControl, 0x03);
  }
  std::uint8_t tick() {
    inputs_.receive = line_.transmit();
    const UartOutputs outputs = device_->tick(inputs_);
    if (const auto byte = line_.receive(outputs.transmit)) sent_.push_back(*byte);
    return outputs.read;
  }
  void run(std::int64_t ticks) {
    for (; ticks > 0; --ticks) tick();
  }
  void write(std::uint32_t address, std::uint8_t value) {
    inputs_.address = address;
    inputs_.writes = true;
    inputs_.written = value;
    tick();
    inputs_.writes = false;
  }
  /// As the core does: the value is there in the tick after the request.
  std::uint8_t read(std::uint32_t address) {
    inputs_.address = address;
    inputs_.reads = true;
    tick();
    inputs_.reads = false;
    return tick();
  }

  UartLine line_{50e6};
  std::vector<std::uint8_t> sent_;

 private:
  std::unique_ptr<UartDevice> device_ = make_uart_device();
  UartInputs inputs_;
};

TEST_F(Uart, SendsAsManyBytesAsItHoldsInTheirOrder) {
  std::vector<std::uint8_t> expected;
  for (std::size_t i = 0; i < kFifo; ++i) expected.push_back(static_cast<std::uint8_t>(3 * i + 1));
  EXPECT_EQ(read(kStatus) & (kEmpty | kIdle), kEmpty | kIdle);
  for (const std::uint8_t byte : expected) write(kData, byte);
  EXPECT_EQ(read(kStatus) & (kEmpty | kIdle), 0);
  run(kByte_ticks * static_cast<std::int64_t>(kFifo));
  EXPECT_EQ(sent_, expected);
  EXPECT_EQ(read(kStatus) & (kEmpty | kIdle), kEmpty | kIdle);
}

TEST_F(Uart, DropsWhatItCannotHoldAndNothingElse) {
  for (std::size_t i = 0; i < kFifo + 20; ++i) write(kData, static_cast<std::uint8_t>(i));
  run(kByte_ticks * static_cast<std::int64_t>(kFifo + 20));
  // The first byte left the FIFO while the others came.
  ASSERT_EQ(sent_.size(), kFifo + 1);
  for (std::size_t i = 0; i < sent_.size(); ++i) EXPECT_EQ(sent_[i], i);
}

TEST_F(Uart, KeepsAsManyBytesAsItHoldsAndTellsTheNextOne) {
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i < kFifo; ++i) bytes.push_back(static_cast<std::uint8_t>(7 * i + 5));
  line_.send(bytes);
  run(kByte_ticks * static_cast<std::int64_t>(kFifo));
  EXPECT_EQ(read(kStatus) & (kSome | kOverrun), kSome);
  line_.send(std::vector<std::uint8_t>{0xEE});
  run(kByte_ticks);
  EXPECT_EQ(read(kStatus) & (kSome | kOverrun), kSome | kOverrun);
  EXPECT_EQ(read(kStatus) & kOverrun, 0) << "reading clears it";
  for (const std::uint8_t byte : bytes) {
    ASSERT_EQ(read(kStatus) & kSome, kSome);
    EXPECT_EQ(read(kData), byte);
  }
  EXPECT_EQ(read(kStatus) & kSome, 0);
}

TEST_F(Uart, KeepsAByteThatArrivesWhileTheProgramWrites) {
  line_.send(std::vector<std::uint8_t>{0x5A});
  run(970);  // its stop bit is sampled within the writes below
  std::vector<std::uint8_t> expected;
  for (std::size_t i = 0; i < kFifo; ++i) expected.push_back(static_cast<std::uint8_t>(i ^ 0x33));
  for (const std::uint8_t byte : expected) write(kData, byte);
  run(10);
  EXPECT_EQ(read(kStatus) & kSome, kSome);
  EXPECT_EQ(read(kData), 0x5A);
  run(kByte_ticks * static_cast<std::int64_t>(kFifo + 1));
  EXPECT_EQ(sent_, expected);
}

TEST_F(Uart, SendsAndReceivesAtOnceWhateverTheProgramDoes) {
  std::mt19937 random(9);
  std::vector<std::uint8_t> expected_out, expected_in, got;
  for (int i = 0; i < 1'500; ++i) expected_in.push_back(static_cast<std::uint8_t>(random()));
  line_.send(expected_in);
  std::size_t in_fifo = 0;
  for (std::int64_t ticks = 0; got.size() < expected_in.size() && ticks < 2'000'000; ++ticks) {
    switch (random() % 8) {
      case 0:
        in_fifo = expected_out.size() - sent_.size();
        if (in_fifo < kFifo) {
          expected_out.push_back(static_cast<std::uint8_t>(random()));
          write(kData, expected_out.back());
        }
        break;
      case 1:
      case 2:
        if ((read(kStatus) & kSome) != 0) got.push_back(read(kData));
        break;
      case 3:
        if (random() % 50 == 0) run(static_cast<std::int64_t>(random() % 60'000));  // it does something else
        break;
      default:
        tick();
    }
  }
  run(kByte_ticks * static_cast<std::int64_t>(kFifo + 2));
  EXPECT_EQ(got, expected_in);
  EXPECT_EQ(sent_, expected_out);
  EXPECT_GT(sent_.size(), 500U);
  EXPECT_EQ(line_.framing_errors(), 0U);
}

}  // namespace
}  // namespace pharos::rtl
