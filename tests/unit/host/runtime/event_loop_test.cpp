// SPDX-License-Identifier: Apache-2.0
#include "host/runtime/event_loop.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <system_error>

#include "host/runtime/signals.hpp"
#include "host/runtime/timer.hpp"

namespace pharos::host {
namespace {

struct Pipe {
  Pipe() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_NONBLOCK | O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category());
    read_end.reset(ends[0]);
    write_end.reset(ends[1]);
  }
  void put(char byte) const { ASSERT_EQ(::write(write_end.get(), &byte, 1), 1); }
  char take() const {
    char byte = 0;
    return ::read(read_end.get(), &byte, 1) == 1 ? byte : '\0';
  }
  UniqueFd read_end;
  UniqueFd write_end;
};

TEST(EventLoop, CallsTheHandlerOfTheDescriptorThatHasBytes) {
  EventLoop loop;
  Pipe first;
  Pipe second;
  std::string seen;
  loop.watch(first.read_end.get(), [&] { seen += first.take(); });
  loop.watch(second.read_end.get(), [&] { seen += second.take(); });
  EXPECT_EQ(loop.turn(0), 0);
  second.put('b');
  EXPECT_EQ(loop.turn(0), 1);
  first.put('a');
  EXPECT_EQ(loop.turn(0), 1);
  EXPECT_EQ(seen, "ba");
}

TEST(EventLoop, AHandlerMayForgetItselfAndItsNeighbour) {
  EventLoop loop;
  Pipe first;
  Pipe second;
  int calls = 0;
  const auto forget_both = [&] {
    ++calls;
    loop.forget(first.read_end.get());
    loop.forget(second.read_end.get());
  };
  loop.watch(first.read_end.get(), forget_both);
  loop.watch(second.read_end.get(), forget_both);
  first.put('a');
  second.put('b');
  loop.turn(0);
  loop.turn(0);
  EXPECT_EQ(calls, 1);
}

TEST(EventLoop, ReportsAWriterThatDisconnected) {
  EventLoop loop;
  Pipe pipe;
  int calls = 0;
  loop.watch(pipe.read_end.get(), [&] {
    ++calls;
    loop.forget(pipe.read_end.get());
  });
  pipe.write_end.reset();
  loop.turn(0);
  EXPECT_EQ(calls, 1);
}

TEST(EventLoop, RefusesWhatCannotBePolled) {
  EventLoop loop;
  UniqueFd file(::open("/proc/self/exe", O_RDONLY | O_CLOEXEC));
  ASSERT_TRUE(file.valid());
  EXPECT_THROW(loop.watch(file.get(), [] {}), std::system_error);
}

TEST(Timer, ExpiresOnceOrPeriodicallyAndStops) {
  EventLoop loop;
  Timer timer;
  std::uint64_t expiries = 0;
  loop.watch(timer.fd(), [&] { expiries += timer.take_expiries(); });
  timer.start(std::chrono::nanoseconds(0));
  EXPECT_EQ(loop.turn(1000), 1);
  EXPECT_EQ(expiries, 1u);
  timer.start_every(std::chrono::milliseconds(1));
  while (expiries < 4) ASSERT_EQ(loop.turn(1000), 1);
  timer.stop();
  timer.take_expiries();
  EXPECT_EQ(loop.turn(5), 0);
}

TEST(Signals, ArriveInLineInsteadOfInterrupting) {
  Signals signals{SIGUSR1, SIGUSR2};
  EXPECT_FALSE(signals.take().has_value());
  ASSERT_EQ(::raise(SIGUSR2), 0);
  ASSERT_EQ(::raise(SIGUSR1), 0);
  const int both = signals.take().value_or(0) + signals.take().value_or(0);
  EXPECT_EQ(both, SIGUSR1 + SIGUSR2);
  EXPECT_FALSE(signals.take().has_value());
}

TEST(Signals, TheOneNamedFirstIsNotHeldUpByOthers) {
  Signals signals{SIGTERM, SIGHUP};  // of lower number is SIGHUP, which the kernel would give first
  ASSERT_EQ(::raise(SIGHUP), 0);
  ASSERT_EQ(::raise(SIGTERM), 0);
  EXPECT_EQ(signals.take(), SIGTERM);
  EXPECT_EQ(signals.take(), SIGHUP);
}

TEST(UniqueFd, ClosesOnceAndMoves) {
  Pipe pipe;
  const int number = pipe.read_end.get();
  UniqueFd moved = std::move(pipe.read_end);
  EXPECT_FALSE(pipe.read_end.valid());  // NOLINT(bugprone-use-after-move)
  EXPECT_EQ(moved.get(), number);
  moved.reset();
  EXPECT_EQ(::fcntl(number, F_GETFD), -1);
}

}  // namespace
}  // namespace pharos::host
