// SPDX-License-Identifier: Apache-2.0
#include "host/device/frame_directory.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <unistd.h>

#include <fstream>

#include "host/device/recorded_source.hpp"
#include "host/images/grey_image.hpp"
#include "host/support/input_error.hpp"
#include "tests/support/error_of.hpp"

namespace pharos::host {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class FrameDirectoryTest : public ::testing::Test {
 protected:
  FrameDirectoryTest() : folder_(fs::path(::testing::TempDir()) / ("frames_" + std::to_string(::getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~FrameDirectoryTest() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  // A raw frame of 2 x 1 pixels: depth and intensity 256 and 257 times `value`.
  void write_raw(const std::string& name, char value, std::size_t size = 16) const {
    std::ofstream(folder_ / name, std::ios::binary) << std::string(size, value);
  }
  std::string refusal(const std::function<void()>& call) const {
    return pharos::test::error_of([&] { call(); });
  }

  fs::path folder_;
};

TEST_F(FrameDirectoryTest, ReadsFramesInTheOrderOfTheirNumbers) {
  write_raw("0010_abcy16.raw", 3);
  write_raw("0002_abcy16.raw", 1);
  write_raw("truth.csv", 0);
  write_raw("x_abcy16.raw", 9);  // no frame number: ignored
  const FrameDirectory frames(folder_.string());
  ASSERT_EQ(frames.frames(), 2u);
  EXPECT_EQ(frames.name(0), "0002");
  DepthFrame frame;
  frames.read(1, 2, 1, frame);
  EXPECT_EQ(frame.depth, (std::vector<std::uint16_t>{0x0303, 0x0303}));
  EXPECT_EQ(frame.width_px, 2);
}

TEST_F(FrameDirectoryTest, ReadsPairsOfImagesAndRefusesThoseOfAnotherSize) {
  const std::vector<std::uint16_t> bright{1, 65'535, 300, 4};
  const std::vector<std::uint16_t> far{0, 12'000, 40'000, 65'535};
  write_grey_png((folder_ / "0000_intensity.png").string(), {bright.data(), 2, 2});
  write_grey_png((folder_ / "0000_depth.png").string(), {far.data(), 2, 2});
  const FrameDirectory frames(folder_.string());
  DepthFrame frame;
  frames.read(0, 2, 2, frame);
  EXPECT_EQ(frame.intensity, bright);
  EXPECT_EQ(frame.depth, far);
  EXPECT_THAT(refusal([&] { frames.read(0, 4, 1, frame); }), HasSubstr("has 2 x 2 pixels, not 4 x 1"));
}

TEST_F(FrameDirectoryTest, TakesOtherFormatsButDepthsAreCounts) {
  const auto write = [&](const std::string& name, const std::string& content) {
    std::ofstream(folder_ / name, std::ios::binary) << content;
  };
  write("0000_intensity.ppm", "P6\n1 1\n255\nABC");
  write("0000_depth.pgm", std::string("P5\n1 1\n65535\n\x01\x02", 15));
  const FrameDirectory frames(folder_.string());
  DepthFrame frame;
  EXPECT_EQ(frames.read(0, 1, 1, frame), (folder_ / "0000_intensity.ppm").string()) << "its luma was taken";
  EXPECT_EQ(frame.intensity, (std::vector<std::uint16_t>{(299 * 'A' + 587 * 'B' + 114 * 'C') * 257 / 1000}));
  EXPECT_EQ(frame.depth, (std::vector<std::uint16_t>{0x0102}));
  write("0000_depth.pgm", "P5\n1 1\n255\nA");
  EXPECT_THAT(refusal([&] { frames.read(0, 1, 1, frame); }), HasSubstr("of 8 bits; depths are grey values of 16"));
  write("0000_depth.tif", std::string("II*\0", 4));
  EXPECT_THAT(refusal([&] { FrameDirectory(folder_.string()); }), HasSubstr("are one frame's; remove one"));
}

TEST_F(FrameDirectoryTest, SaysWhatIsWrong) {
  EXPECT_THAT(refusal([&] { FrameDirectory((folder_ / "none").string()); }), HasSubstr("give a directory"));
  EXPECT_THAT(refusal([&] { FrameDirectory(folder_.string()); }), HasSubstr("holds no frames"));
  write_raw("0001_abcy16.raw", 1, 15);
  DepthFrame frame;
  EXPECT_THAT(refusal([&] { FrameDirectory(folder_.string()).read(0, 2, 1, frame); }),
              HasSubstr("is not the 16 bytes of 2 x 1 pixels"));
  write_raw("0007_depth.png", 1);
  EXPECT_THAT(refusal([&] { FrameDirectory(folder_.string()); }), HasSubstr("0007_intensity.png: is missing"));
}

TEST_F(FrameDirectoryTest, AsASourceRemarksOnColour) {
  std::ofstream(folder_ / "1_intensity.ppm", std::ios::binary) << "P6\n1 1\n255\nABC";
  std::ofstream(folder_ / "1_depth.pgm", std::ios::binary) << "P5\n1 1\n65535\nAB";
  RecordedSource source(folder_.string(), 1, 1, 0.0);
  EXPECT_EQ(source.status().remark, "");
  pollfd waiting{source.fd(), POLLIN, 0};
  ASSERT_EQ(::poll(&waiting, 1, 10'000), 1);
  ASSERT_TRUE(source.take());
  EXPECT_THAT(source.status().remark, HasSubstr("1_intensity.ppm: is in colour; its luma"));
}

TEST_F(FrameDirectoryTest, IsASourceThatEndsAndCountsWhatCannotBeRead) {
  write_raw("0001_abcy16.raw", 1);
  write_raw("0002_abcy16.raw", 1, 3);
  write_raw("0003_abcy16.raw", 2);
  RecordedSource source(folder_.string(), 2, 1, 0.0);
  std::vector<std::uint16_t> depths;
  while (!source.status().finished) {
    pollfd waiting{source.fd(), POLLIN, 0};
    ASSERT_EQ(::poll(&waiting, 1, 10'000), 1);
    if (DepthFramePtr frame = source.take()) {
      depths.push_back(frame->depth[0]);
      EXPECT_EQ(frame->clock, CameraClock::kHost);
      source.recycle(std::move(frame));
    }
  }
  EXPECT_EQ(depths, (std::vector<std::uint16_t>{0x0101, 0x0202}));
  EXPECT_EQ(source.status().counters.frames_received, 2);
  EXPECT_EQ(source.status().counters.frames_wrong_size, 1);
}

}  // namespace
}  // namespace pharos::host
