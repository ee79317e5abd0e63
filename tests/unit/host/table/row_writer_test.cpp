// SPDX-License-Identifier: Apache-2.0
#include "host/table/row_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <sstream>

#include "host/support/input_error.hpp"
#include "host/table/table_reader.hpp"
#include "tests/support/temporary_file.hpp"

namespace pharos::host {
namespace {

using pharos::test::TemporaryFile;

template <class Fill>
std::string written(RowFormat format, std::vector<std::string> columns, Fill&& fill, const RowExtras& extras = {}) {
  char* text = nullptr;
  std::size_t size = 0;
  std::FILE* stream = open_memstream(&text, &size);
  {
    RowWriter writer(stream, format, std::move(columns), extras);
    fill(writer);
  }
  std::fclose(stream);
  std::string out(text, size);
  std::free(text);
  return out;
}

void fill_two_rows(RowWriter& writer) {
  writer.number(0.1).integer(-7).text("ok").none().end_row();
  writer.number(std::numeric_limits<double>::quiet_NaN())
      .integer(3)
      .text("a,b\"\n")
      .number(-std::numeric_limits<double>::infinity())
      .end_row();
}

TEST(RowWriter, WritesCsvAndNeverNan) {
  EXPECT_EQ(written(RowFormat::kCsv, {"x", "n", "status", "y"}, fill_two_rows),
            "x,n,status,y\n0.1,-7,ok,\n,3,a b\" ,\n");
}

TEST(RowWriter, WritesTheSameNamesAsJsonLines) {
  EXPECT_EQ(written(RowFormat::kJson, {"x", "n", "status", "y"}, fill_two_rows),
            "{\"x\":0.1,\"n\":-7,\"status\":\"ok\",\"y\":null}\n"
            "{\"x\":null,\"n\":3,\"status\":\"a,b\\\"\\u000a\",\"y\":null}\n");
}

TEST(RowWriter, ATextHasNoCharacterThatATerminalObeys) {
  const auto fill = [](RowWriter& writer) { writer.text("a\x1b[2J\x07\x7f\tb").end_row(); };
  EXPECT_EQ(written(RowFormat::kCsv, {"a"}, fill), "a\na [2J   b\n");
  EXPECT_EQ(written(RowFormat::kJson, {"a"}, fill), "{\"a\":\"a\\u001b[2J\\u0007\\u007f\\u0009b\"}\n");
}

TEST(RowWriter, WhatIsEmptyInCsvIsNullInJson) {
  const auto fill = [](RowWriter& writer) { writer.text("").none().text("x").end_row(); };
  EXPECT_EQ(written(RowFormat::kCsv, {"a", "b", "c"}, fill), "a,b,c\n,,x\n");
  EXPECT_EQ(written(RowFormat::kJson, {"a", "b", "c"}, fill), "{\"a\":null,\"b\":null,\"c\":\"x\"}\n");
}

TEST(RowWriter, WritesTheHeaderEvenWithoutRows) {
  EXPECT_EQ(written(RowFormat::kCsv, {"a", "b"}, [](RowWriter&) {}), "a,b\n");
  EXPECT_EQ(written(RowFormat::kJson, {"a", "b"}, [](RowWriter&) {}), "");
}

TEST(RowWriter, WritesNumbersThatReadBackExactly) {
  std::mt19937_64 random(20021);
  std::vector<double> values = {0.0, -0.0, 0.1, 1.0 / 3.0, 5e-324, std::numeric_limits<double>::max(), 16.123456789};
  while (values.size() < 2000) {
    const double value = std::bit_cast<double>(random());
    if (std::isfinite(value)) values.push_back(value);
  }
  const std::string text = written(RowFormat::kCsv, {"v"}, [&](RowWriter& writer) {
    for (const double value : values) writer.number(value).end_row();
  });
  const TemporaryFile file(text);
  TableReader table(ByteSource(file.path()), {"v"});
  for (const double value : values) {
    ASSERT_TRUE(table.next());
    EXPECT_EQ(std::bit_cast<std::uint64_t>(table.number(0)), std::bit_cast<std::uint64_t>(value));
  }
}

// Numbers that tell their row and column.
RowPose pose_with_covariance() {
  RowPose pose{2.0, Quaternion::Identity(), Vector3(1.0, 2.0, 3.0)};
  pose.covariance = Matrix6::Zero();
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) (*pose.covariance)(i, j) = 10 * i + j;
  }
  return pose;
}

TEST(RowWriter, AppendsTheCovarianceRowByRowAndNothingWhereThereIsNone) {
  const auto fill = [](RowWriter& writer) {
    writer.text("ok").pose(pose_with_covariance()).end_row();
    writer.text("refused").end_row();
  };
  const std::string text = written(RowFormat::kCsv, {"status"}, fill, {true, ""});
  const TemporaryFile file(text);
  std::vector<std::string> columns = covariance_columns();
  ASSERT_EQ(columns.size(), 36U);
  EXPECT_EQ(columns[0], "cov_rx_rx_rad2");
  EXPECT_EQ(columns[3], "cov_rx_tx_rad_m");
  EXPECT_EQ(columns[18], "cov_tx_rx_rad_m");
  EXPECT_EQ(columns[35], "cov_tz_tz_m2");
  TableReader table(ByteSource(file.path()), columns);
  ASSERT_TRUE(table.next());
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const std::size_t row = k / 6;
    EXPECT_EQ(table.number(k), 10.0 * static_cast<double>(row) + static_cast<double>(k % 6)) << columns[k];
  }
  ASSERT_TRUE(table.next());
  for (std::size_t k = 0; k < columns.size(); ++k) EXPECT_TRUE(table.empty(k)) << "not that of the row before";
  EXPECT_EQ(text.substr(0, 22), "status,cov_rx_rx_rad2,");
}

TEST(RowWriter, AsTumWritesThePosesAlone) {
  const auto fill = [](RowWriter& writer) {
    writer.number(2.0).text("ok").pose(pose_with_covariance()).end_row();
    writer.none().text("refused").end_row();
    EXPECT_EQ(writer.rows(), 2U);
    EXPECT_EQ(writer.tum().left_out().refused, 1U);
  };
  EXPECT_EQ(written(RowFormat::kTum, {"time_s", "status"}, fill), "2.0 1.0 2.0 3.0 0.0 0.0 0.0 1.0\n");
}

TEST(RowWriter, ReportsAFullDisk) {
  std::FILE* full = std::fopen("/dev/full", "w");
  ASSERT_NE(full, nullptr);
  {
    RowWriter writer(full, RowFormat::kCsv, {"a"});
    EXPECT_THROW(writer.flush(), InputError);
  }
  std::fclose(full);
}

}  // namespace
}  // namespace pharos::host
