// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/unwrapped_counters.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "pharos/wire/counters_message.hpp"

namespace pharos::host {
namespace {

std::map<std::string, std::int64_t> values_of(const UnwrappedCounters& counters) {
  std::map<std::string, std::int64_t> values;
  counters.visit(wire::DeviceCounters{},
                 [&](const char* name, std::int64_t value, const char*) { values[name] = value; });
  return values;
}

TEST(UnwrappedCounters, GoOnBeyond32BitsForYears) {
  UnwrappedCounters counters;
  std::int64_t truth = 0;
  for (int second = 0; second < 40; ++second, truth += 2'000'000'011) {
    wire::DeviceCounters told;
    told.frames_sent = static_cast<std::uint32_t>(truth);
    counters.take(told);
    EXPECT_EQ(values_of(counters)["frames_sent"], truth);
    EXPECT_EQ(values_of(counters)["commands"], 0);
  }
  EXPECT_GT(truth, std::int64_t{1} << 36);
}

TEST(UnwrappedCounters, AGaugeMayFall) {
  UnwrappedCounters counters;
  for (const std::uint32_t permille : {40u, 990u, 12u, 0u, 500u}) {
    wire::DeviceCounters told;
    told.busy_permille = permille;
    counters.take(told);
    EXPECT_EQ(values_of(counters)["busy_permille"], permille);
  }
}

TEST(UnwrappedCounters, ATargetThatBeganAnewCountsFromItsNewStart) {
  UnwrappedCounters counters;
  wire::DeviceCounters told;
  told.frames_sent = 4'000'000'000;
  counters.take(told);
  counters.clear();
  EXPECT_TRUE(values_of(counters).empty()) << "not told yet";
  told.frames_sent = 17;
  counters.take(told);
  EXPECT_EQ(values_of(counters)["frames_sent"], 17);
}

}  // namespace
}  // namespace pharos::host
