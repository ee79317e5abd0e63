// SPDX-License-Identifier: Apache-2.0
#include "host/runtime/log_writer.hpp"

#include <gtest/gtest.h>

#include <future>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace pharos::host {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

LogWriter::Line note(std::uint64_t dropped) { return {0, std::to_string(dropped) + " dropped"}; }

// A log destination that blocks at the first line until it is opened.
struct Place {
  std::promise<void> open;
  std::shared_future<void> opened = open.get_future().share();
  std::promise<void> reached;
  bool first = true;
  std::mutex mutex;
  std::vector<std::string> lines;

  bool write(const LogWriter::Line& line) {
    if (first) {
      first = false;
      reached.set_value();
      opened.wait();
    }
    const std::lock_guard lock(mutex);
    lines.push_back(line.text);
    return true;
  }
};

std::unique_ptr<LogWriter> writer_to(const std::shared_ptr<Place>& place) {
  return std::make_unique<LogWriter>([place](const LogWriter::Line& line) { return place->write(line); }, note);
}

TEST(LogWriter, WritesEveryLineInOrder) {
  const auto place = std::make_shared<Place>();
  place->open.set_value();
  const auto writer = writer_to(place);
  for (int i = 0; i < 100; ++i) writer->push({0, std::to_string(i)});
  writer->finish(seconds(20));
  ASSERT_EQ(place->lines.size(), 100u);
  for (std::size_t i = 0; i < 100; ++i) EXPECT_EQ(place->lines[i], std::to_string(i));
  EXPECT_EQ(writer->dropped(), 0u);
}

TEST(LogWriter, DropsTheOldestLinesOfAPlaceThatHangsAndSaysHowMany) {
  const auto place = std::make_shared<Place>();
  const auto writer = writer_to(place);
  writer->push({0, "first"});
  place->reached.get_future().wait();  // the writer's thread is blocked in that line
  constexpr std::size_t kTooMany = 7;
  for (std::size_t i = 0; i < LogWriter::kMaxLines + kTooMany; ++i) writer->push({0, std::to_string(i)});
  EXPECT_EQ(writer->dropped(), kTooMany);
  place->open.set_value();
  writer->finish(seconds(20));
  ASSERT_EQ(place->lines.size(), LogWriter::kMaxLines + 2);
  EXPECT_EQ(place->lines[1], "7 dropped");
  EXPECT_EQ(place->lines[2], "7");
}

TEST(LogWriter, LeavesAPlaceThatHangsBehind) {
  const auto place = std::make_shared<Place>();
  auto writer = writer_to(place);
  writer->push({0, "line"});
  place->reached.get_future().wait();
  writer->finish(milliseconds(1));
  writer->push({0, "too late"});
  EXPECT_EQ(writer->dropped(), 1u);
  writer.reset();  // its thread continues
  place->open.set_value();
}

TEST(LogWriter, CountsLinesThatCannotBeWrittenAndCutsLongOnes) {
  std::vector<std::size_t> sizes;
  LogWriter writer(
      [&](const LogWriter::Line& line) {
        sizes.push_back(line.text.size());
        return line.text != "refused\n";
      },
      note);
  writer.push({0, "refused\n"});
  writer.push({0, std::string(3 * LogWriter::kMaxLine_bytes, 'x') + '\n'});
  writer.finish(seconds(20));
  EXPECT_EQ(writer.dropped(), 1u);
  EXPECT_EQ(sizes.back(), LogWriter::kMaxLine_bytes);
}

}  // namespace
}  // namespace pharos::host
