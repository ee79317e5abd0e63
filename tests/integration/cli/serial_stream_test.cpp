// SPDX-License-Identifier: Apache-2.0
// A recorded serial stream as EDGES: sweeps decoded by the target, or its raw edges, give the same as the table of its
// pulses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "host/record/stream_format.hpp"
#include "host/table/edges_reader.hpp"
#include "pharos/lighthouse/decoder.hpp"
#include "pharos/report/reporter.hpp"
#include "tests/integration/cli/example_recording.hpp"

namespace pharos::cli_test {
namespace {

// A recording file with the frames sent to it, one chunk a frame.
class StreamFile {
 public:
  StreamFile() : bytes_(host::stream_format::encode_head({"demo", 460'800, 0, 0})) {}
  void send(report::Reporter::Bytes frame) {
    if (frame.empty()) return;
    host::stream_format::append_chunk({0, 0, 0, frame}, bytes_);
  }
  std::string text() const { return {reinterpret_cast<const char*>(bytes_.data()), bytes_.size()}; }

 private:
  std::vector<std::uint8_t> bytes_;
};

std::string decoded_stream() {
  StreamFile file;
  report::Reporter reporter;
  const auto decoder = std::make_unique<lighthouse::Decoder>();
  host::EdgesReader reader{host::ByteSource(ExampleRecording::get().edges())};
  const auto send_all = [&] {
    while (const auto sweep = decoder->take_sweep()) file.send(reporter.report(*sweep));
    while (const auto payload = decoder->take_ootx()) file.send(reporter.report(*payload));
  };
  while (const auto pulse = reader.next()) {
    decoder->push(*pulse);
    send_all();
  }
  decoder->flush();
  send_all();
  return file.text();
}

std::string raw_edges_stream() {
  std::vector<lighthouse::Edge> edges;
  host::EdgesReader reader{host::ByteSource(ExampleRecording::get().edges())};
  while (const auto pulse = reader.next()) {
    edges.push_back({pulse->rise_ticks, pulse->sensor, true});
    edges.push_back({pulse->fall_ticks, pulse->sensor, false});
  }
  std::stable_sort(edges.begin(), edges.end(),
                   [](const auto& a, const auto& b) { return a.stamp_ticks < b.stamp_ticks; });
  StreamFile file;
  report::Reporter reporter;
  for (const lighthouse::Edge& edge : edges) file.send(reporter.report(edge, 0));
  file.send(reporter.flush_edges());
  return file.text();
}

std::string table_rows(const std::string& more = "") {
  return pharos("decode " + ExampleRecording::get().edges() + " " + more).out;
}

TEST(CliSerialStream, GivesTheSameRowsAsTheTableOfItsPulses) {
  const Folder folder;
  const std::string stream = folder.write("decoded.phraw", decoded_stream());
  const Outcome run = pharos("decode " + stream);
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.err, "");
  EXPECT_EQ(run.out, table_rows());
  EXPECT_EQ(pharos("decode " + stream + " --ootx").out, table_rows("--ootx"));
  const std::string target = " --target " + ExampleRecording::get().target();
  EXPECT_EQ(pharos("track " + stream + target).out, pharos("track " + ExampleRecording::get().edges() + target).out);
}

TEST(CliSerialStream, DecodesTheRawEdgesOfTheDiagnosticMode) {
  const Folder folder;
  const Outcome run = pharos("decode " + folder.write("edges.phraw", raw_edges_stream()));
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.out, table_rows());
}

TEST(CliSerialStream, ComesOverStandardInputToo) {
  EXPECT_EQ(count_lines(pharos("decode -", decoded_stream()).out), count_lines(table_rows()));
}

TEST(CliSerialStream, SaysWhatWasDamagedAndUsesTheRest) {
  std::string text = decoded_stream();
  for (std::size_t i = text.size() / 2; i < text.size() / 2 + 40; ++i) text[i] = '\x33';
  text.resize(text.size() - 5);
  const Folder folder;
  const Outcome run = pharos("decode --stats " + folder.write("damaged.phraw", text));
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.err, ::testing::HasSubstr("damaged and dropped"));
  EXPECT_THAT(run.err, ::testing::HasSubstr("cut off in the middle of a chunk"));
  EXPECT_THAT(run.err, ::testing::ContainsRegex("frames_lost +[1-9]"));
  EXPECT_GT(count_lines(run.out), count_lines(table_rows()) * 9 / 10);
}

}  // namespace
}  // namespace pharos::cli_test
