// SPDX-License-Identifier: Apache-2.0
#include "tools/view/state_json.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "pharos/bearings_t.hpp"
#include "some_messages.hpp"

namespace pharos::tools {
namespace {

using Json = nlohmann::json;

using test::kSecond_ns;

ViewContext context_at(std::int64_t now_ns) {
  ViewContext context;
  context.utc_ns = context.now_ns = now_ns;
  context.viewers = 2;
  return context;
}

Json state_of(const SourceTable& table, std::int64_t now_ns = kSecond_ns) {
  return Json::parse(state_json(table, context_at(now_ns)));
}

TEST(StateJson, TellsAPoseInItsUnits) {
  SourceTable table;
  table.add("PHAROS_LIGHTHOUSE_POSE", test::some_pose(), kSecond_ns, kSecond_ns);
  const Json row = state_of(table)["rows"][0];
  EXPECT_EQ(row["source"], "lighthouse/chaser");
  EXPECT_EQ(row["p"], Json({0.5, -0.25, 2.0}));
  EXPECT_EQ(row["q"], Json({1.0, 0.0, 0.0, 0.0}));
  EXPECT_EQ(row["covariance"][0], 1e-6);
  EXPECT_EQ(row["sigma_m"], 0.001);
  EXPECT_EQ(row["age_s"], 1.0);
  EXPECT_EQ(row["rate"], 1);
  EXPECT_EQ(row["lights"].size(), 4u);
  EXPECT_EQ(row["frames"], Json({"lighthouse", "body"}));
}

TEST(StateJson, AValueThatIsNotCurrentIsNotThere) {
  SourceTable table;
  table.add("PHAROS_LIGHTHOUSE_POSE", test::some_pose(), kSecond_ns, kSecond_ns);
  const Json row = state_of(table, 4 * kSecond_ns)["rows"][0];
  EXPECT_FALSE(row["current"]);
  EXPECT_FALSE(row.contains("p"));
  EXPECT_EQ(row["lights"][3][0], "bad");
}

TEST(StateJson, SensorsAreToldWithTheirDirectionsAndGoDarkWithTime) {
  SourceTable table;
  table.add("PHAROS_LIGHTHOUSE_POSE", test::some_pose(), kSecond_ns, kSecond_ns);
  bearings_t bearings{};
  bearings.source = "lighthouse/chaser";
  bearings.target = "dock";
  bearing_t bearing{};
  bearing.sensor = 3;
  bearing.ideal_theta_rad = std::atan2(1.0, 0.25);
  bearing.used = 1;
  bearings.bearings = {bearing};
  table.add(bearings, kSecond_ns);
  const Json row = state_of(table)["rows"][0];
  EXPECT_EQ(row["sensors"], Json::array({Json::array({3, true, 0.25, nullptr})}));
  EXPECT_FALSE(state_of(table, 4 * kSecond_ns)["rows"][0].contains("sensors"));
}

TEST(StateJson, AnyTextIsOneLineOfValidJson) {
  SourceTable table;
  pose_t pose = test::some_pose();
  pose.target = "\xff\xfe\n</script>\"\\\x01\xc3";
  pose.flags = std::string("\0a", 2);
  pose.status = "\xe2\x82";
  table.add("PHAROS_LIGHTHOUSE_POSE", pose, kSecond_ns, kSecond_ns);
  const std::string text = state_json(table, context_at(kSecond_ns));
  EXPECT_EQ(text.find('\n'), std::string::npos) << "an event of the stream ends at a line's end";
  EXPECT_TRUE(Json::accept(text));
}

TEST(StateJson, CountersAndReplayAreTold) {
  SourceTable table;
  table.take("PHAROS_STATUS", "garbage", 7, 0, 0);
  ViewContext context = context_at(kSecond_ns);
  context.replay = ReplayState{1.5, 60.0, 2.0, false, 3};
  const Json state = Json::parse(state_json(table, context));
  EXPECT_EQ(state["counters"]["foreign"], 1);
  EXPECT_EQ(state["counters"]["viewers"], 2);
  EXPECT_EQ(state["replay"]["position_s"], 1.5);
  EXPECT_EQ(state["replay"]["skipped"], 3);
  EXPECT_FALSE(state_of(table).contains("replay"));
}

TEST(StateJson, TargetsAreTheirSensorsPositions) {
  Target target;
  target.push_back({4, Vector3(0.1, 0.2, 0.3), Vector3::Zero()});
  EXPECT_EQ(Json::parse(targets_json({{"dock", target}})), Json::parse(R"({"dock":[[4,[0.1,0.2,0.3]]]})"));
}

}  // namespace
}  // namespace pharos::tools
