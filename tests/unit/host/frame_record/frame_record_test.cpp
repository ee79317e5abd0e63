// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <random>
#include <thread>

#include "host/frame_record/frame_reader.hpp"
#include "host/frame_record/frame_recorder.hpp"
#include "host/record/recording_file.hpp"
#include "host/support/input_error.hpp"
#include "some_frames.hpp"
#include "support/temporary_folder.hpp"

namespace pharos::host {
namespace {

using pharos::test::Bytes;
using pharos::test::TemporaryFolder;
using test::some_frame;

FrameRecorderOptions options(const std::filesystem::path& directory) {
  FrameRecorderOptions options;
  options.directory = directory;
  options.camera = "helios";
  return options;
}

// Waits for each frame, so that none finds the queue full.
void append_and_wait(FrameRecorder& recorder, const DepthFrame& frame) {
  const FrameRecordingCounters before = recorder.counters();
  recorder.append(frame);
  while (recorder.counters().frames + recorder.counters().frames_lost == before.frames + before.frames_lost) {
    std::this_thread::yield();
  }
}

// A recording of so many frames; returns its file.
std::filesystem::path recorded(const TemporaryFolder& folder, int count, bool has_depth = true) {
  FrameRecorder recorder(options(folder.path()));
  for (int k = 0; k < count; ++k) append_and_wait(recorder, some_frame(k, has_depth));
  return folder.files().front();
}

struct Read {
  std::vector<DepthFrame> frames;
  FrameReaderCounters counters;
  bool cut_off = false;
};

Read read(const std::filesystem::path& file) {
  FrameReader reader{ByteSource(file.string())};
  Read read;
  for (DepthFrame frame; reader.next(frame);) read.frames.push_back(frame);
  read.counters = reader.counters();
  read.cut_off = reader.cut_off();
  return read;
}

TEST(FrameRecord, GivesBackEveryPixelAndTime) {
  for (const bool has_depth : {true, false}) {
    const TemporaryFolder folder;
    const auto file = recorded(folder, 5, has_depth);
    EXPECT_EQ(file.filename(), "helios_20251121T103000Z.phcam");
    const Read back = read(file);
    ASSERT_EQ(back.frames.size(), 5u);
    for (int k = 0; k < 5; ++k) {
      EXPECT_TRUE(test::equal(back.frames[static_cast<std::size_t>(k)], some_frame(k, has_depth))) << k;
    }
    EXPECT_FALSE(back.cut_off);
    EXPECT_EQ(back.counters.dropped_bytes, 0u);
    EXPECT_EQ(back.counters.frames_missing, 0);
  }
}

TEST(FrameRecord, ACutFileGivesAllFramesBeforeTheCut) {
  const TemporaryFolder folder;
  const auto file = recorded(folder, 3);
  const Bytes whole = pharos::test::content(file);
  const std::size_t head = frame_format::head_bytes(whole), frame = (whole.size() - head) / 3;
  for (std::size_t size = head; size < whole.size(); size += 7) {
    pharos::test::write_file(file, Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)));
    const Read back = read(file);
    EXPECT_EQ(back.frames.size(), (size - head) / frame) << size;
    EXPECT_EQ(back.cut_off, (size - head) % frame != 0) << size;
  }
}

TEST(FrameRecord, DamageLosesTheFramesThatItTouchesAndCountsThem) {
  const TemporaryFolder folder;
  const auto file = recorded(folder, 6);
  const Bytes whole = pharos::test::content(file);
  const std::size_t head = frame_format::head_bytes(whole);
  std::mt19937 random(11);
  for (int trial = 0; trial < 200; ++trial) {
    Bytes broken = whole;
    const std::size_t at = head + random() % (whole.size() - head);
    broken[at] = static_cast<std::uint8_t>(broken[at] ^ (1U << random() % 8));
    pharos::test::write_file(file, broken);
    const Read back = read(file);
    EXPECT_EQ(back.frames.size(), 5u) << at;
    EXPECT_GT(back.counters.dropped_bytes, 0u);
    const bool inside = at >= head + (whole.size() - head) / 6 && at < whole.size() - (whole.size() - head) / 6;
    EXPECT_EQ(back.counters.frames_missing, inside ? 1 : 0) << "a gap in the numbers, where frames are on both sides";
  }
}

TEST(FrameRecord, WhatIsNoRecordingIsRefused) {
  const TemporaryFolder folder;
  Bytes bytes = pharos::test::content(recorded(folder, 1));
  EXPECT_THROW(read(folder.write("text.phcam", "frame,time\n")), InputError);
  EXPECT_THROW(read(folder.path()), InputError);
  bytes[20] ^= 1;
  pharos::test::write_file(folder.path() / "bad_head.phcam", bytes);
  EXPECT_THROW(read(folder.path() / "bad_head.phcam"), InputError);
}

TEST(FrameRecord, ADirectoryThatCannotBeWrittenLosesCountedFramesAndSaysWhy) {
  const TemporaryFolder folder;
  FrameRecorder recorder(options(folder.write("a_file", "") + "/inside"));
  for (int k = 0; k < 5; ++k) append_and_wait(recorder, some_frame(k));
  EXPECT_EQ(recorder.counters().frames_lost, 5);
  EXPECT_EQ(recorder.counters().failures, 1) << "tried again once a second";
  EXPECT_NE(recorder.error().find("cannot be opened"), std::string::npos);
  append_and_wait(recorder, some_frame(40));
  EXPECT_EQ(recorder.counters().failures, 2);
}

TEST(FrameRecord, TheLimitDeletesTheOldestFilesOfThisCameraAlone) {
  const TemporaryFolder folder;
  folder.write("other_20200101T000000Z.phcam", std::string(5000, 'x'));
  folder.write("helios_notes.phcam", "x");
  FrameRecorderOptions small = options(folder.path());
  small.rotate_bytes = 1000;  // some frames
  small.limit_bytes = 5000;
  FrameRecorder recorder(small);
  constexpr int kFrames = 60;
  for (int k = 0; k < kFrames; ++k) append_and_wait(recorder, some_frame(k));
  const auto files = recording_files(folder.path(), "helios", kFramesSuffix);
  std::uint64_t sum = 0;
  std::size_t frames = 0;
  for (const auto& file : files) {
    sum += std::filesystem::file_size(file);
    const Read back = read(file);
    for (const DepthFrame& frame : back.frames) {
      EXPECT_TRUE(test::equal(frame, some_frame(static_cast<int>(frame.intensity[0] / 1000)))) << "whole files remain";
    }
    frames += back.frames.size();
    EXPECT_TRUE(&file != &files.back() || back.frames.back().intensity[0] == 1000 * (kFrames - 1)) << "the newest";
  }
  EXPECT_LE(sum, small.limit_bytes);
  EXPECT_LT(frames, static_cast<std::size_t>(kFrames));
  EXPECT_EQ(recorder.counters().frames, kFrames);
  EXPECT_GT(recorder.counters().files_deleted, 0);
  EXPECT_EQ(recorder.counters().files - recorder.counters().files_deleted, static_cast<std::int64_t>(files.size()));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "other_20200101T000000Z.phcam"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "helios_notes.phcam"));
}

TEST(FrameRecord, ADiskThatIsTooSlowLosesCountedFramesAndNeverWaits) {
  const TemporaryFolder folder;
  constexpr int kFrames = 4000;
  FrameRecordingCounters counters;
  {
    FrameRecorder recorder(options(folder.path()));
    for (int k = 0; k < kFrames; ++k) recorder.append(some_frame(k % 50));  // times go back: a rotation does not matter
    while (recorder.counters().frames + recorder.counters().frames_lost < kFrames) std::this_thread::yield();
    counters = recorder.counters();
  }
  EXPECT_EQ(counters.frames + counters.frames_lost, kFrames) << "nothing is lost silently";
  EXPECT_GE(counters.frames, static_cast<std::int64_t>(FrameRecorder::kMaxWaiting));
}

}  // namespace
}  // namespace pharos::host
