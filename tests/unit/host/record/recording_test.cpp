// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <zlib.h>

#include <random>

#include "host/record/stream_reader.hpp"
#include "host/record/stream_recorder.hpp"
#include "host/support/input_error.hpp"
#include "pharos/report/link_decoder.hpp"
#include "pharos/report/reporter.hpp"
#include "support/temporary_folder.hpp"

namespace pharos::host {
namespace {

using pharos::test::Bytes;
using pharos::test::TemporaryFolder;

constexpr std::int64_t kStartUtc_ns = 1'763'721'000'000'000'000;  // 2025-11-21T10:30:00Z
constexpr std::int64_t kMs = 1'000'000;

struct Appended {
  std::int64_t utc_ns;
  std::int64_t monotonic_ns;
  Bytes bytes;
};

std::vector<Appended> append_random(StreamRecorder& recorder, std::size_t chunks, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<Appended> all;
  for (std::size_t i = 0; i < chunks; ++i) {
    Appended one{kStartUtc_ns + static_cast<std::int64_t>(i) * 8 * kMs,
                 77 * kMs + static_cast<std::int64_t>(i) * 8 * kMs, Bytes(1 + random() % 300)};
    for (auto& byte : one.bytes) byte = static_cast<std::uint8_t>(random());
    recorder.append(one.bytes, one.utc_ns, one.monotonic_ns);
    all.push_back(std::move(one));
  }
  return all;
}

std::vector<Appended> read_all(StreamReader& reader) {
  std::vector<Appended> all;
  while (const auto chunk = reader.next()) {
    all.push_back({chunk->utc_ns, chunk->monotonic_ns, {chunk->bytes.begin(), chunk->bytes.end()}});
  }
  return all;
}

void expect_equal(const std::vector<Appended>& got, const std::vector<Appended>& wanted) {
  ASSERT_EQ(got.size(), wanted.size());
  for (std::size_t i = 0; i < got.size(); ++i) {
    EXPECT_EQ(got[i].utc_ns, wanted[i].utc_ns);
    EXPECT_EQ(got[i].monotonic_ns, wanted[i].monotonic_ns);
    ASSERT_EQ(got[i].bytes, wanted[i].bytes) << "chunk " << i;
  }
}

TEST(Recording, GivesBackEveryByteWithItsTimes) {
  TemporaryFolder folder;
  StreamRecorder recorder({folder.path() / "made" / "by need", "chaser", 460'800});
  const auto sent = append_random(recorder, 500, 1);
  EXPECT_EQ(recorder.file().filename(), "chaser_20251121T103000Z.phraw");
  EXPECT_TRUE(recorder.error().empty());

  StreamReader reader{ByteSource(recorder.file())};
  EXPECT_EQ(reader.header().target, "chaser");
  EXPECT_EQ(reader.header().baud, 460'800u);
  EXPECT_EQ(reader.header().utc_ns, kStartUtc_ns);
  EXPECT_EQ(reader.header().monotonic_ns, 77 * kMs);
  expect_equal(read_all(reader), sent);
  EXPECT_FALSE(reader.cut_off());
  EXPECT_EQ(reader.dropped_bytes(), 0u);
}

TEST(Recording, BeginsANewFileBySizeAndLosesNothingBetween) {
  TemporaryFolder folder;
  StreamRecorder recorder({folder.path(), "chaser", 460'800, 10'000, 1e9});
  const auto sent = append_random(recorder, 500, 2);
  const auto files = folder.files();
  EXPECT_EQ(files.size(), recorder.counters().files);
  EXPECT_GT(files.size(), 5u);
  std::vector<Appended> got;
  std::vector<std::filesystem::path> by_start = files;
  std::sort(by_start.begin(), by_start.end(), [](const auto& a, const auto& b) {
    return StreamReader{ByteSource(a)}.header().monotonic_ns < StreamReader{ByteSource(b)}.header().monotonic_ns;
  });
  for (const auto& file : by_start) {
    EXPECT_LT(std::filesystem::file_size(file), 10'400u);
    StreamReader reader{ByteSource(file)};
    for (auto& chunk : read_all(reader)) got.push_back(std::move(chunk));
  }
  expect_equal(got, sent);
}

TEST(Recording, BeginsANewFileByTime) {
  TemporaryFolder folder;
  StreamRecorder recorder({folder.path(), "chaser", 460'800, 1u << 30, 2.0});
  append_random(recorder, 1000, 3);  // 8 s
  EXPECT_EQ(folder.files().size(), 4u);
}

TEST(Recording, ReadsAGzippedRecording) {
  TemporaryFolder folder;
  StreamRecorder recorder({folder.path(), "chaser", 460'800});
  const auto sent = append_random(recorder, 200, 4);
  const Bytes plain = pharos::test::content(recorder.file());
  const std::string packed = (folder.path() / "packed.phraw.gz").string();
  gzFile file = gzopen(packed.c_str(), "wb");
  ASSERT_EQ(gzwrite(file, plain.data(), static_cast<unsigned>(plain.size())), static_cast<int>(plain.size()));
  gzclose(file);
  StreamReader reader{ByteSource(packed)};
  expect_equal(read_all(reader), sent);
}

TEST(Recording, PlaysBackIntoTheLinkDecoder) {
  TemporaryFolder folder;
  StreamRecorder recorder({folder.path(), "chaser", 460'800});
  report::Reporter reporter;
  for (int i = 0; i < 100; ++i) recorder.append(reporter.report_time(i), kStartUtc_ns + i, i);
  StreamReader reader{ByteSource(recorder.file())};
  report::LinkDecoder link;
  std::int64_t expected = 0;
  while (const auto chunk = reader.next()) {
    for (const std::uint8_t byte : chunk->bytes) {
      const auto event = link.push(byte);
      if (!event) continue;
      EXPECT_EQ(report::newest_ticks(*event), expected);
      ++expected;
    }
  }
  EXPECT_EQ(expected, 100);
}

TEST(Recording, DistinguishesItsFilesFromOthers) {
  TemporaryFolder folder;
  StreamRecorder recorder({folder.path(), "chaser", 460'800});
  append_random(recorder, 1, 5);
  EXPECT_TRUE(StreamReader::looks_like(ByteSource(recorder.file()).peek(StreamReader::kHeaderBytes)));
  EXPECT_FALSE(StreamReader::looks_like("sensor,rise_ticks,fall_ticks"));
  EXPECT_FALSE(StreamReader::looks_like(""));
  pharos::test::write_file(folder.path() / "table.csv", {'s', 'e', 'n', 's', 'o', 'r', '\n'});
  EXPECT_THROW(StreamReader{ByteSource(folder.path() / "table.csv")}, InputError);
}

TEST(Recording, SaysWhichVersionANewerRecordingHas) {
  TemporaryFolder folder;
  StreamRecorder recorder({folder.path(), "chaser", 460'800});
  append_random(recorder, 1, 6);
  Bytes bytes = pharos::test::content(recorder.file());
  bytes[8] = 2;
  pharos::test::write_file(folder.path() / "newer", bytes);
  try {
    StreamReader reader{ByteSource(folder.path() / "newer")};
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("version 2"), std::string::npos) << error.what();
  }
}

TEST(Recording, SplitsWhatIsLongerThanAChunk) {
  TemporaryFolder folder;
  StreamRecorder recorder({folder.path(), "chaser", 460'800});
  const Bytes longer(200'000, 0xC5);
  recorder.append(longer, kStartUtc_ns, 0);
  StreamReader reader{ByteSource(recorder.file())};
  Bytes got;
  for (const auto& chunk : read_all(reader)) got.insert(got.end(), chunk.bytes.begin(), chunk.bytes.end());
  EXPECT_EQ(got, longer);
}

}  // namespace
}  // namespace pharos::host
