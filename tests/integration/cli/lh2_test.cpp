// SPDX-License-Identifier: Apache-2.0
// Lighthouse 2.0 from light to poses by the programs: sim lighthouse, decode --lh2-light, track --sweeps.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <memory>
#include <sstream>

#include "host/record/stream_format.hpp"
#include "host/table/lh2_light_reader.hpp"
#include "pharos/lighthouse/lh2_light_decoder.hpp"
#include "pharos/report/reporter.hpp"
#include "tests/integration/cli/program.hpp"

namespace pharos::cli_test {
namespace {

using ::testing::HasSubstr;

// The example scenario, shorter.
std::string short_scenario(const Folder& folder) {
  const std::string scenarios = PHAROS_SCENARIOS;
  std::string text = content_of(scenarios + "/lh2.toml");
  const auto replace = [&](const std::string& what, const std::string& with) {
    text.replace(text.find(what), what.size(), with);
  };
  replace("duration_s = 20.0", "duration_s = 2.0");
  replace("\"target12.csv\"", "\"" + scenarios + "/target12.csv\"");
  std::ofstream(folder.path("s.toml")) << text;
  return folder.path("s.toml");
}

TEST(CliLh2, LightBecomesSweepsAndPoses) {
  const Folder folder;
  const std::string out = folder.path("r");
  const Outcome simulated = pharos("sim lighthouse " + short_scenario(folder) + " --seed 2 --output " + out);
  ASSERT_EQ(simulated.exit_code, 0) << simulated.err;
  const Outcome decoded = pharos("decode --lh2-light " + out + "/light.csv.gz");
  ASSERT_EQ(decoded.exit_code, 0) << decoded.err;
  EXPECT_EQ(first_line(decoded.out),
            "time_s,station,station_id,axis,sensor,theta_rad,width_ticks,flags,generation,sync_s,offset_bits,slow_bit");
  EXPECT_GE(count_lines(decoded.out) * 100, count_lines(content_of(out + "/passes.csv")) * 98);
  double last_s = 0.0;
  for (const Row& row : rows_of(decoded.out)) {
    EXPECT_TRUE(row.at("station") == "6" || row.at("station") == "1");
    EXPECT_EQ(row.at("generation"), "2");
    const double time_s = std::stod(row.at("time_s"));
    EXPECT_GE(time_s, last_s);
    last_s = time_s;
  }
  std::ofstream(folder.path("sweeps.csv")) << decoded.out;
  const Outcome tracked = pharos("track --sweeps " + folder.path("sweeps.csv") + " --stations " + out +
                                 "/stations.toml --target " + out + "/target.csv");
  ASSERT_EQ(tracked.exit_code, 0) << tracked.err;
  std::size_t ok = 0;
  for (const Row& row : rows_of(tracked.out)) ok += row.at("status") == "ok" ? 1U : 0U;
  EXPECT_GE(ok, 350U);  // 2 stations, 2 planes, 50 turns/s, 2 s
}

// The recorded serial stream of a target that decoded this light.
std::string stream_of(const std::string& light) {
  std::vector<std::uint8_t> bytes = host::stream_format::encode_head({"dock", 460'800, 0, 0});
  report::Reporter reporter;
  const auto sequences = std::make_unique<lighthouse::Lh2Sequences>();
  const auto decoder = std::make_unique<lighthouse::Lh2LightDecoder>(*sequences);
  const auto send = [&](report::Reporter::Bytes frame) {
    if (!frame.empty()) host::stream_format::append_chunk({0, 0, 0, frame}, bytes);
  };
  const auto send_all = [&] {
    while (const auto payload = decoder->take_ootx()) send(reporter.report(report::Lh2OotxReport{*payload}));
    while (const auto sweep = decoder->take_sweep()) send(reporter.report(*sweep));
  };
  host::Lh2LightReader reader{host::ByteSource(light)};
  while (const auto edge = reader.next()) {
    decoder->push(*edge);
    send_all();
  }
  decoder->flush();
  send_all();
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TEST(CliLh2, ARecordedStreamGivesTheRowsOfItsLight) {
  const Folder folder;
  const std::string out = folder.path("r"), stream = folder.path("dock.phraw");
  ASSERT_EQ(pharos("sim lighthouse " + short_scenario(folder) + " --seed 3 --output " + out).exit_code, 0);
  std::ofstream(stream, std::ios::binary) << stream_of(out + "/light.csv.gz");
  const Outcome of_light = pharos("decode --lh2-light " + out + "/light.csv.gz");
  const Outcome of_stream = pharos("decode " + stream);
  ASSERT_EQ(of_stream.exit_code, 0) << of_stream.err;
  EXPECT_EQ(of_stream.out, of_light.out);
  std::ofstream(folder.path("sweeps.csv")) << of_light.out;
  const std::string rest = " --stations " + out + "/stations.toml --target " + out + "/target.csv";
  const Outcome tracked = pharos("track " + stream + rest);
  ASSERT_EQ(tracked.exit_code, 0) << tracked.err;
  EXPECT_EQ(tracked.out, pharos("track --sweeps " + folder.path("sweeps.csv") + rest).out);
  EXPECT_EQ(pharos("track " + stream + " --sweeps " + folder.path("sweeps.csv") + rest).exit_code, 2);
  const Outcome without = pharos("track " + stream + " --target " + out + "/target.csv");
  EXPECT_EQ(without.exit_code, 2);
  EXPECT_THAT(without.err, HasSubstr("--stations"));
}

TEST(CliLh2, EachBurstsBitsAreShown) {
  const Folder folder;
  const std::string out = folder.path("r");
  ASSERT_EQ(pharos("sim lighthouse " + short_scenario(folder) + " --output " + out).exit_code, 0);
  const Outcome bits = pharos("decode --bits --lh2-light " + out + "/light.csv.gz");
  ASSERT_EQ(bits.exit_code, 0) << bits.err;
  EXPECT_EQ(first_line(bits.out),
            "time_s,sensor,channel,slow_bit,offset_bits,sync_s,axis,theta_rad,width_ticks,agreeing,bits_time_s,bits");
  for (const Row& row : rows_of(bits.out)) {
    EXPECT_GE(row.at("bits").size(), 17U);
    EXPECT_EQ(row.at("bits").find_first_not_of("01x"), std::string::npos);
  }
}

TEST(CliLh2, WrongUsageIsSaid) {
  const Folder folder;
  const std::string light = folder.path("l.csv");
  std::ofstream(light) << "sensor,time_ticks,data,envelope\n0,1,0,1\n0,2,7,1\n";
  const Outcome bad = pharos("decode --lh2-light " + light);
  EXPECT_EQ(bad.exit_code, 2);
  EXPECT_THAT(bad.err, HasSubstr("l.csv: line 3: column 'data': '7' is not 0 or 1"));
  EXPECT_EQ(pharos("decode --bits " + light).exit_code, 2);
  EXPECT_EQ(pharos("decode --lh2-light --ootx --bits " + light).exit_code, 2);
  EXPECT_EQ(pharos("decode --lh2-light --smooth " + light).exit_code, 2);
  std::ofstream(light) << "sensor,time_ticks,data,envelope\n0,1,0,1\n";
  const Outcome dark = pharos("decode --lh2-light " + light);
  EXPECT_EQ(dark.exit_code, 1);
  EXPECT_THAT(dark.err, HasSubstr("no hit"));
}

}  // namespace
}  // namespace pharos::cli_test
