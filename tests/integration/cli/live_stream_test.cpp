// SPDX-License-Identifier: Apache-2.0
// A recording in progress: rows are printed as soon as the pipe pauses.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/stat.h>

#include <array>
#include <cstdio>
#include <memory>

#include "host/support/unique_fd.hpp"
#include "tests/integration/cli/example_recording.hpp"

namespace pharos::cli_test {
namespace {

using ::testing::StartsWith;

// `pharos ARGUMENTS` with pipes for its standard input and output.
class LiveRun {
 public:
  explicit LiveRun(const std::string& arguments) {
    const std::string pipe = folder_.path("out");
    EXPECT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    out_.reset(::open(pipe.c_str(), O_RDONLY | O_NONBLOCK));
    input_.reset(::popen((std::string(PHAROS_PROGRAM) + " " + arguments + " >" + pipe).c_str(), "w"));
  }
  // Sends more input; the program then waits for the next.
  void send(const std::string& text) {
    EXPECT_EQ(std::fwrite(text.data(), 1, text.size(), input_.get()), text.size());
    std::fflush(input_.get());
  }
  // Whether `lines` lines were printed within 20 s.
  bool wait_for_lines(std::size_t lines) {
    constexpr int kLongest_ms = 20'000;
    while (count_lines(text_) < lines) {
      pollfd ready{out_.get(), POLLIN, 0};
      if (::poll(&ready, 1, kLongest_ms) <= 0) return false;
      std::array<char, 4096> piece;
      const ssize_t got = ::read(out_.get(), piece.data(), piece.size());
      if (got <= 0) return false;
      text_.append(piece.data(), static_cast<std::size_t>(got));
    }
    return true;
  }
  const std::string& text() const { return text_; }

 private:
  struct Close {
    void operator()(std::FILE* input) const { ::pclose(input); }
  };
  Folder folder_;
  host::UniqueFd out_;
  std::unique_ptr<std::FILE, Close> input_;
  std::string text_;
};

// About the first `seconds` of the recording, cut at a line's end.
std::string beginning(double seconds) {
  const std::string whole = recording().edges_text();
  const auto size = static_cast<std::size_t>(static_cast<double>(whole.size()) * seconds / 12.0);
  return whole.substr(0, whole.find('\n', size) + 1);
}

TEST(CliLiveStream, DecodeShowsItsRowsWhenTheInputPauses) {
  LiveRun run("decode -");
  run.send(beginning(0.5));
  // Far less than the size of any buffer: 60 sweeps a second of some eight sensors, without the first tenth of a second
  // before lock.
  ASSERT_TRUE(run.wait_for_lines(200)) << run.text().size();
  EXPECT_LT(run.text().size(), 64u * 1024u);
  EXPECT_THAT(run.text(), StartsWith("time_s,station,"));
}

TEST(CliLiveStream, TrackShowsItsPosesWhenTheInputPauses) {
  LiveRun run("track - --target " + recording().target());
  run.send(beginning(0.5));
  ASSERT_TRUE(run.wait_for_lines(15)) << run.text();
  EXPECT_THAT(run.text(), StartsWith("time_s,station,qw"));
}

TEST(CliLiveStream, TheHeaderComesWithTheFirstLine) {
  LiveRun run("decode -");
  run.send("sensor,rise_ticks,fall_ticks\n1,1000,2000\n");
  EXPECT_TRUE(run.wait_for_lines(1));
}

}  // namespace
}  // namespace pharos::cli_test
