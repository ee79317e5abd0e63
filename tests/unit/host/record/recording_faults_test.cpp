// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <limits>
#include <random>

#include "host/record/stream_reader.hpp"
#include "host/record/stream_recorder.hpp"
#include "host/support/input_error.hpp"
#include "support/temporary_folder.hpp"

namespace pharos::host {
namespace {

using pharos::test::Bytes;
using pharos::test::TemporaryFolder;

constexpr std::int64_t kUtc = 1'763'721'000'000'000'000;
constexpr std::int64_t kS = 1'000'000'000;

struct Read {
  Bytes bytes;
  std::size_t chunks = 0;
  bool cut_off = false;
  std::uint64_t dropped = 0;
  std::uint64_t lost = 0;
};

Read read_all(const std::filesystem::path& file) {
  StreamReader reader{ByteSource(file)};
  Read read;
  while (const auto chunk = reader.next()) {
    read.bytes.insert(read.bytes.end(), chunk->bytes.begin(), chunk->bytes.end());
    ++read.chunks;
  }
  read.cut_off = reader.cut_off();
  read.dropped = reader.dropped_bytes();
  read.lost = reader.lost_bytes();
  return read;
}

/// Limits file sizes of this process to `bytes`: the kernel refuses writes as on a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limited{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limited);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;
  ~FileSizeLimit() { ::setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_{};
};

TEST(RecordingFaults, AFileCutAnywhereGivesAllWholeChunksBefore) {
  TemporaryFolder folder;
  StreamRecorder recorder({folder.path(), "chaser", 460'800});
  std::vector<std::uintmax_t> ends;
  for (std::uint8_t i = 0; i < 8; ++i) {
    recorder.append(Bytes(5, i), kUtc, i);
    ends.push_back(std::filesystem::file_size(recorder.file()));
  }
  const Bytes whole = pharos::test::content(recorder.file());
  const std::size_t head = ends[0] - (ends[1] - ends[0]);
  for (std::size_t size = 0; size <= whole.size(); ++size) {
    const auto cut = folder.path() / "cut";
    pharos::test::write_file(cut, Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)));
    if (size < head) {
      EXPECT_THROW(read_all(cut), InputError) << size;
      continue;
    }
    const Read read = read_all(cut);
    const auto chunks =
        static_cast<std::size_t>(std::count_if(ends.begin(), ends.end(), [&](auto end) { return end <= size; }));
    EXPECT_EQ(read.chunks, chunks) << size;
    EXPECT_EQ(read.cut_off, size != head && std::find(ends.begin(), ends.end(), size) == ends.end()) << size;
  }
}

TEST(RecordingFaults, DamageCostsTheChunkItHitsAndNoOther) {
  TemporaryFolder folder;
  StreamRecorder recorder({folder.path(), "chaser", 460'800});
  std::mt19937_64 random(5);
  for (int i = 0; i < 50; ++i) {
    Bytes bytes(20 + random() % 50);
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random() % 4 == 0 ? 0xC5 : random());
    recorder.append(bytes, kUtc, i);
  }
  const Bytes whole = pharos::test::content(recorder.file());
  const std::size_t head = 30 + 6 + 4;
  for (std::size_t at = head; at < whole.size(); at += 7) {
    Bytes damaged = whole;
    damaged[at] ^= 0x40;
    pharos::test::write_file(folder.path() / "damaged", damaged);
    const Read read = read_all(folder.path() / "damaged");
    EXPECT_EQ(read.chunks, 49u) << "byte " << at;
    EXPECT_GT(read.dropped, 0u);
  }
}

TEST(RecordingFaults, AFullDiskLosesBytesAndSaysSoAndGoesOnWhenThereIsRoom) {
  TemporaryFolder folder;
  StreamRecorder recorder({folder.path(), "chaser", 460'800});
  const Bytes chunk(100, 7);
  std::int64_t now = 0;
  const auto append = [&](int times) {
    for (int i = 0; i < times; ++i, now += kS / 100) recorder.append(chunk, kUtc + now, now);
  };
  append(10);
  {
    FileSizeLimit no_room(20);  // not even for a new file's head
    append(500);
    EXPECT_FALSE(recorder.error().empty());
    EXPECT_NE(recorder.error().find("not being recorded"), std::string::npos) << recorder.error();
    EXPECT_EQ(recorder.counters().bytes_lost, 500u * 100u);
    EXPECT_LE(recorder.counters().failures, 8u) << "tried once a second, not at every byte";
    EXPECT_EQ(folder.files().size(), 1u) << "no empty files are left";
  }
  append(200);
  EXPECT_TRUE(recorder.error().empty()) << recorder.error();
  const RecorderCounters& counters = recorder.counters();
  EXPECT_EQ(counters.bytes_recorded + counters.bytes_lost, 710u * 100u);
  EXPECT_GE(counters.bytes_recorded, (10u + 100u) * 100u);

  const auto files = folder.files();
  ASSERT_EQ(files.size(), 2u);
  const Read before = read_all(files[0]);
  EXPECT_EQ(before.bytes.size(), 1000u);
  EXPECT_FALSE(before.cut_off) << "the file was cut back to its last whole chunk";
  const Read after = read_all(files[1]);
  EXPECT_EQ(after.lost, counters.bytes_lost) << "the recording itself tells the hole";
  EXPECT_EQ(before.bytes.size() + after.bytes.size(), counters.bytes_recorded);
}

TEST(RecordingFaults, ADiskWithRoomForAHeadAndNoChunkIsNotFilledWithHeads) {
  TemporaryFolder folder;
  StreamRecorder recorder({folder.path(), "chaser", 460'800});
  {
    FileSizeLimit only_a_head(60);
    for (std::int64_t now = 0; now < 20 * kS; now += kS / 10) {
      recorder.append(Bytes(100, 7), kUtc + now, now);
      ASSERT_TRUE(folder.files().empty()) << now;
    }
    EXPECT_NE(recorder.error().find("not being recorded"), std::string::npos) << recorder.error();
    EXPECT_GE(recorder.counters().failures, 19u) << "it was tried";
    EXPECT_EQ(recorder.counters().files, 0u);
  }
  recorder.append(Bytes(100, 8), kUtc + 30 * kS, 30 * kS);
  EXPECT_EQ(recorder.counters().files, 1u);
  EXPECT_EQ(read_all(recorder.file()).lost, 200u * 100u);
}

// Chunks of one byte each, the byte being their index, at these times.
struct Times {
  std::int64_t utc_ns;
  std::int64_t monotonic_ns;
};
std::filesystem::path recording_at(const TemporaryFolder& folder, const std::vector<Times>& times) {
  Bytes bytes = stream_format::encode_head({"chaser", 460'800, kUtc, 50 * kS});
  for (std::uint8_t i = 0; i < times.size(); ++i) {
    stream_format::append_chunk({times[i].utc_ns, times[i].monotonic_ns, 0, {&i, 1}}, bytes);
  }
  pharos::test::write_file(folder.path() / "hostile", bytes);
  return folder.path() / "hostile";
}

TEST(RecordingFaults, ImpossibleTimesAreDroppedAndCountedAndAffectNoOther) {
  constexpr std::int64_t kYear = 365 * 86'400 * kS;
  constexpr std::int64_t kMin = std::numeric_limits<std::int64_t>::min();
  constexpr std::int64_t kMax = std::numeric_limits<std::int64_t>::max();
  TemporaryFolder folder;
  const auto file = recording_at(folder, {{kUtc, 50 * kS},                    // 0
                                          {kUtc, 50 * kS + 100 * kYear},      // sleep 100 years
                                          {kUtc, 51 * kS},                    // 2
                                          {kUtc, 49 * kS},                    // backwards
                                          {kUtc, kMax},                       //
                                          {kUtc, kMin},                       //
                                          {kMax, 52 * kS},                    // UTC beyond all bounds
                                          {kMin, 52 * kS},                    //
                                          {kUtc - 3600 * kS, 52 * kS},        // 8: the clock was set
                                          {kUtc, 52 * kS + 7 * 86'400 * kS},  // 9: a week of silence
                                          {kUtc, 53 * kS}});                  // backwards now
  StreamReader reader{ByteSource(file)};
  Bytes got;
  std::int64_t last_ns = 0;
  std::uint64_t lost = 0;
  while (const auto chunk = reader.next()) {
    got.push_back(chunk->bytes[0]);
    lost += chunk->lost_before;
    EXPECT_GE(chunk->monotonic_ns, last_ns);
    last_ns = chunk->monotonic_ns;
  }
  EXPECT_EQ(got, (Bytes{0, 2, 8, 9}));
  EXPECT_EQ(reader.bad_times(), 7u);
  EXPECT_EQ(lost, 6u) << "whoever decodes the stream knows that bytes are missing";
}

TEST(RecordingFaults, AHeadOfImpossibleTimesIsRefused) {
  TemporaryFolder folder;
  for (const std::int64_t bad :
       {std::numeric_limits<std::int64_t>::min(), std::int64_t{-1}, std::numeric_limits<std::int64_t>::max()}) {
    pharos::test::write_file(folder.path() / "bad", stream_format::encode_head({"chaser", 460'800, kUtc, bad}));
    EXPECT_THROW(read_all(folder.path() / "bad"), InputError) << bad;
  }
}

TEST(RecordingFaults, AChunkThatFitsOnlyHalfIsCutBack) {
  TemporaryFolder folder;
  StreamRecorder recorder({folder.path(), "chaser", 460'800});
  recorder.append(Bytes(100, 1), kUtc, 0);
  const auto file = recorder.file();
  const auto size = std::filesystem::file_size(file);
  {
    FileSizeLimit limit(size + 50);
    recorder.append(Bytes(100, 2), kUtc, 1);
  }
  EXPECT_EQ(std::filesystem::file_size(file), size);
  EXPECT_EQ(recorder.counters().bytes_lost, 100u);
}

TEST(RecordingFaults, AFolderThatCannotBeMadeIsReportedAndTriedAgain) {
  TemporaryFolder folder;
  const auto blocked = folder.path() / "recordings";
  pharos::test::write_file(blocked, {'x'});  // a file where the folder should be
  StreamRecorder recorder({blocked, "chaser", 460'800});
  recorder.append(Bytes(10, 1), kUtc, 0);
  EXPECT_NE(recorder.error().find(blocked.string()), std::string::npos) << recorder.error();
  EXPECT_TRUE(recorder.file().empty());
  std::filesystem::remove(blocked);
  recorder.append(Bytes(10, 2), kUtc, kS / 2);
  EXPECT_FALSE(recorder.error().empty());
  recorder.append(Bytes(10, 3), kUtc, kS);
  EXPECT_TRUE(recorder.error().empty());
  EXPECT_EQ(recorder.counters().bytes_lost, 20u);
  EXPECT_EQ(read_all(recorder.file()).lost, 20u);
}

}  // namespace
}  // namespace pharos::host
