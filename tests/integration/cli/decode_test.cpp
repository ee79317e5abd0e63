// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <sstream>

#include "pharos/lighthouse/decoder_counters.hpp"
#include "pharos/lighthouse/station_model.hpp"
#include "tests/integration/cli/example_recording.hpp"

namespace pharos::cli_test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

Outcome decode(const std::string& more = "") { return pharos("decode " + recording().edges() + " " + more); }

lighthouse::StationCalibration calibration_from(const Row& row) {
  lighthouse::StationCalibration station;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const std::string suffix = std::to_string(axis);
    station.rotor[axis] = {std::stod(row.at("phase" + suffix)), std::stod(row.at("tilt" + suffix)),
                           std::stod(row.at("curve" + suffix)), std::stod(row.at("gibphase" + suffix)),
                           std::stod(row.at("gibmag" + suffix))};
  }
  return station;
}

TEST(CliDecode, PrintsTheColumnsOfTheContract) {
  const Outcome run = decode();
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.err, "");
  EXPECT_EQ(first_line(run.out), "time_s,station,station_id,axis,sensor,theta_rad,width_ticks,flags");
}

TEST(CliDecode, GivesTheRawAngleOfEverySensorBeforeTheStationModel) {
  const auto station = calibration_from(rows_of(decode("--ootx").out).at(0));
  const auto rows = rows_of(decode().out);
  ASSERT_GT(rows.size(), 1000u);
  // Ticks of 20 ns: a hit's centre is accurate to half a tick, 3.8 urad, the flash to one.
  constexpr double kTick_rad = 7.6e-6;
  for (const Row& row : rows) {
    const auto* placement =
        find_sensor(recording().target_as_built(), static_cast<std::uint8_t>(std::stoi(row.at("sensor"))));
    ASSERT_NE(placement, nullptr);
    const Axis axis = row.at("axis") == "x" ? Axis::kX : Axis::kY;
    const double expected = lighthouse::raw_theta(station, lighthouse::ModelForm::kForm1, axis,
                                                  recording().truth() * placement->position_m);
    ASSERT_NEAR(std::stod(row.at("theta_rad")), expected, 2 * kTick_rad) << "sensor " << row.at("sensor");
  }
}

TEST(CliDecode, NamesTheStationFromTheFirstRowOfAFile) {
  const auto rows = rows_of(decode().out);
  EXPECT_EQ(rows.front().at("station"), "0");
  EXPECT_EQ(rows.front().at("station_id"), ExampleRecording::kStationId);
}

TEST(CliDecode, TimesRunForwardOnTheRecordingsCounter) {
  const auto rows = rows_of(decode().out);
  // The simulated counter starts at 1 s.
  EXPECT_NEAR(std::stod(rows.front().at("time_s")), 1.0, 0.2);
  EXPECT_NEAR(std::stod(rows.back().at("time_s")), 13.0, 0.1);
  double last = 0.0;
  for (const Row& row : rows) {
    EXPECT_GT(std::stod(row.at("time_s")), last - 0.008);  // within one sweep hits are in the order of their ends
    last = std::stod(row.at("time_s"));
  }
}

TEST(CliDecode, ReadsTheSameFromStandardInput) {
  const std::string with_ids = decode().out;
  const Outcome plain = pharos("decode -", recording().edges_text());
  const Outcome packed = pharos("decode -", content_of(recording().edges()));
  EXPECT_EQ(plain.exit_code, 0);
  EXPECT_EQ(plain.out, packed.out);
  EXPECT_EQ(count_lines(plain.out), count_lines(with_ids));
  // A stream cannot be read ahead: its first rows have no station id yet, its last ones do.
  EXPECT_EQ(rows_of(plain.out).front().at("station_id"), "");
  EXPECT_EQ(rows_of(plain.out).back(), rows_of(with_ids).back());
}

TEST(CliDecode, PrintsJsonLinesWithTheSameNames) {
  const Outcome run = decode("--json");
  EXPECT_THAT(
      first_line(run.out),
      ::testing::MatchesRegex("\\{\"time_s\":[0-9.]+,\"station\":0,\"station_id\":\"BEC08E38\",\"axis\":\"[xy]\","
                              "\"sensor\":[0-9]+,\"theta_rad\":[0-9.]+,\"width_ticks\":[0-9]+,\"flags\":\".*\"\\}"));
  EXPECT_EQ(count_lines(run.out) + 1, count_lines(decode().out));
}

TEST(CliDecode, WritesToAFileWhenAsked) {
  const Folder folder;
  const Outcome run = decode("--output " + folder.path("rows.csv"));
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(content_of(folder.path("rows.csv")), decode().out);
}

TEST(CliDecode, GivesOotxPayloads) {
  const Outcome run = decode("--ootx");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.out, StartsWith("time_s,station,station_id,payload_hex,phase0,"));
  const auto rows = rows_of(run.out);
  ASSERT_GE(rows.size(), 3u);
  for (const Row& row : rows) {
    EXPECT_EQ(row.at("station_id"), ExampleRecording::kStationId);
    EXPECT_EQ(row.at("payload_hex").size(), 66u);
    EXPECT_THAT(row.at("payload_hex").substr(4, 8), "388ec0be");  // the id, little-endian
    EXPECT_NEAR(std::stod(row.at("phase0")), 0.03, 1e-5);
    EXPECT_NEAR(std::stod(row.at("gibmag1")), 0.004, 2e-6);
  }
}

TEST(CliDecode, PrintsEveryCounterOnStandardError) {
  const Outcome run = decode("--stats");
  lighthouse::for_each_counter(lighthouse::DecoderCounters{}, [&](const char* name, std::uint32_t, const char* text) {
    EXPECT_THAT(run.err, HasSubstr(std::string(name) + " "));
    EXPECT_THAT(run.err, HasSubstr(text));
  });
  EXPECT_EQ(run.out, decode().out);
}

TEST(CliDecode, SmoothingChangesAnglesOnly) {
  const auto raw = rows_of(decode().out);
  const auto smooth = rows_of(decode("--smooth").out);
  ASSERT_EQ(raw.size(), smooth.size());
  for (std::size_t i = 0; i < raw.size(); ++i) {
    EXPECT_EQ(raw[i].at("time_s"), smooth[i].at("time_s"));
    EXPECT_NEAR(std::stod(raw[i].at("theta_rad")), std::stod(smooth[i].at("theta_rad")), 1e-4);
  }
}

TEST(CliDecode, UnwrapsA32BitCounter) {
  // The same light with a counter that wraps: the same angles, continuous times.
  std::string text = "sensor,rise_ticks,fall_ticks\n";
  std::istringstream lines(recording().edges_text());
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    long long sensor = 0, rise = 0, fall = 0;
    ASSERT_EQ(std::sscanf(line.c_str(), "%lld,%lld,%lld", &sensor, &rise, &fall), 3);
    const auto wrapped = [](long long ticks) { return std::to_string((ticks + 4'000'000'000ll) & 0xFFFFFFFFll); };
    text += std::to_string(sensor) + "," + wrapped(rise) + "," + wrapped(fall) + "\n";
  }
  const Folder folder;
  const auto shifted = rows_of(pharos("decode " + folder.write("wrapped.csv", text)).out);
  const auto rows = rows_of(decode().out);
  ASSERT_EQ(shifted.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(shifted[i].at("theta_rad"), rows[i].at("theta_rad"));
    EXPECT_NEAR(std::stod(shifted[i].at("time_s")) - std::stod(rows[i].at("time_s")), 80.0, 1e-9);
  }
}

}  // namespace
}  // namespace pharos::cli_test
