// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "one_of_each.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tools/export/mcap_export.hpp"

namespace pharos::test {

/// A log of some seconds: poses of which two are not good, a status, bearings, messages of others.
inline std::string example_log() {
  std::string log;
  for (int k = 0; k < 300; ++k) {
    pose_t pose = some_pose(k);
    if (k == 7) pose.status = "ambiguous";
    if (k == 8) pose.status = "refused_too_few", pose.valid = 0;
    log += logged(kSomeTime_us + 9000 * k, "PHAROS_LIGHTHOUSE_POSE", encoded(pose));
  }
  log += logged(kSomeTime_us, "PHAROS_STATUS", encoded(some_status()));
  log += logged(kSomeTime_us, "PHAROS_LIGHTHOUSE_BEARINGS", encoded(some_bearings()));
  pointing_t pointing{};
  pointing.status = "ok";
  log += logged(kSomeTime_us, "PHAROS_LINE_POINTING", encoded(pointing));
  log += logged(kSomeTime_us, "PHAROS_SLAM_SPIN", encoded(spin_t{}));
  log += logged(kSomeTime_us, "PHAROS_CLOCK", encoded(clock_exchange_t{}));
  log += logged(kSomeTime_us, "PHAROS_TARGET_STATE", encoded(some_state()));
  target_state_t conflict = some_state();
  conflict.has_conflict = 1;
  log += logged(kSomeTime_us, "PHAROS_TARGET_STATE", encoded(conflict));
  log += logged(kSomeTime_us, "PHAROS_PREVIEW", encoded(some_preview("tof/helios", "")));
  log += logged(kSomeTime_us, "PHAROS_PREVIEW", encoded(some_preview("ring2/bow", "left")));
  log += logged(kSomeTime_us, "PHAROS_LIGHTHOUSE_POSE", "a message of another system");
  log += logged(kSomeTime_us, "OTHER", "\xFF\xFE");
  pose_t not_finite = some_pose(0);
  not_finite.position_m[1] = std::numeric_limits<double>::infinity();
  log += logged(kSomeTime_us, "PHAROS_LIGHTHOUSE_POSE", encoded(not_finite));
  log += logged(-5, "PHAROS_LIGHTHOUSE_POSE", encoded(some_pose(1)));
  return log;
}

/// Writes the log's messages as an MCAP file; returns what became of them.
inline std::map<std::string, tools::ChannelCounts> export_log(const TemporaryFolder& folder, const std::string& log,
                                                              const std::string& path) {
  tools::LcmLogReader reader{host::ByteSource(folder.write("log", log))};
  std::FILE* file = std::fopen(path.c_str(), "wb");
  EXPECT_NE(file, nullptr);
  tools::McapExport mcap(file, "pharos test");
  while (const auto message = reader.next()) mcap.push(*message);
  mcap.finish();
  std::fclose(file);
  return mcap.channels();
}

/// Output of a program by line as JSON; empty, and `failed`, where it ended with another code than 0.
struct ReadBack {
  std::vector<nlohmann::ordered_json> messages;
  bool failed = false;
  std::string text;
};
inline ReadBack read_back(const TemporaryFolder& folder, const std::string& command) {
  const std::string out = folder.path("out");
  const int status = std::system((command + " >" + out + " 2>" + folder.path("err")).c_str());
  ReadBack read;
  read.failed = !WIFEXITED(status) || WEXITSTATUS(status) != 0;
  std::ifstream lines(read.failed ? folder.path("err") : out);
  for (std::string line; std::getline(lines, line);) {
    if (!read.failed) read.messages.push_back(nlohmann::ordered_json::parse(line));
    read.text += line + '\n';
  }
  return read;
}

inline std::vector<nlohmann::ordered_json> of_topic(const ReadBack& read, const std::string& topic) {
  std::vector<nlohmann::ordered_json> out;
  for (const auto& message : read.messages) {
    if (message["topic"] == topic) out.push_back(message);
  }
  return out;
}

/// Bytes of base64 by the alphabet of RFC 4648; of anything else none.
inline std::vector<std::uint8_t> from_base64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<std::uint8_t> bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') break;
    const std::size_t digit = digits.find(c);
    if (digit == std::string::npos) return {};
    bits = bits << 6U | static_cast<std::uint32_t>(digit);
    count += 6;
    if (count >= 8) bytes.push_back(static_cast<std::uint8_t>(bits >> (count -= 8) & 255U));
  }
  return bytes;
}

inline void expect_pictures(const ReadBack& read) {
  EXPECT_EQ(of_topic(read, "/PHAROS_PREVIEW").size(), 2U);
  for (const auto& [topic, frame] : {std::pair("/PHAROS_PREVIEW/tof/helios/image", "tof/helios/camera"),
                                     std::pair("/PHAROS_PREVIEW/ring2/bow/left/image", "ring2/bow/left")}) {
    const auto images = of_topic(read, topic);
    ASSERT_EQ(images.size(), 1U) << topic;
    EXPECT_EQ(images[0]["schema"], "foxglove.CompressedImage");
    EXPECT_EQ(images[0]["data"]["format"], "jpeg");
    EXPECT_EQ(images[0]["data"]["frame_id"], frame);
    EXPECT_EQ(images[0]["data"]["timestamp"]["nsec"], 123'456'000);
    EXPECT_EQ(from_base64(images[0]["data"]["data"]), some_preview("", "").data);
  }
}

/// The example's messages as they must come back from any reader.
inline void expect_example(const ReadBack& read) {
  ASSERT_FALSE(read.failed) << read.text;
  const auto poses = of_topic(read, "/PHAROS_LIGHTHOUSE_POSE");
  ASSERT_EQ(poses.size(), 300U);
  for (int k = 0; k < 300; ++k) {
    const auto& message = poses[static_cast<std::size_t>(k)];
    const pose_t pose = some_pose(k);
    EXPECT_EQ(message["schema"], "pharos.pose");
    EXPECT_EQ(message["sequence"], k);
    EXPECT_EQ(message["log_time"], (kSomeTime_us + 9000 * k) * 1000);
    EXPECT_EQ(message["publish_time"], pose.utime * 1000);
    EXPECT_EQ(message["data"]["utime"], pose.utime);
    EXPECT_EQ(message["data"]["valid"], k != 8);
    EXPECT_EQ(message["data"]["flags"], "fused|outliers");
    EXPECT_EQ(message["data"]["sigma_rot_rad"], 1.0 / 3.0) << "to the last bit";
    for (std::size_t i = 0; i < 36; ++i) EXPECT_EQ(message["data"]["covariance"][i], pose.covariance[i]);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(message["data"]["position_m"][i], pose.position_m[i]);
  }
  const auto transforms = of_topic(read, "/PHAROS_LIGHTHOUSE_POSE/transform");
  ASSERT_EQ(transforms.size(), 298U) << "without the ambiguous and the refused one";
  EXPECT_EQ(transforms[0]["schema"], "foxglove.FrameTransform");
  const auto& first = transforms[0]["data"];
  EXPECT_EQ(first["timestamp"]["sec"], 1'700'000'000);
  EXPECT_EQ(first["timestamp"]["nsec"], 123'456'000);
  EXPECT_EQ(first["parent_frame_id"], "lighthouse/chaser/station0/lighthouse");
  EXPECT_EQ(first["child_frame_id"], "lighthouse/chaser/station0/dock/body");
  EXPECT_NEAR(first["rotation"]["y"].get<double>(), -0.6, 1e-15);
  EXPECT_EQ(of_topic(read, "/PHAROS_LIGHTHOUSE_POSE/pose").size(), 298U);
  const auto status = of_topic(read, "/PHAROS_STATUS");
  ASSERT_EQ(status.size(), 1U);
  EXPECT_EQ(status[0]["data"]["message"], "one \"quoted\" word");
  EXPECT_EQ(status[0]["data"]["sources"][0]["pose_age_us"], -1);
  const auto counters = of_topic(read, "/PHAROS_STATUS/counters");
  ASSERT_EQ(counters.size(), 1U);
  EXPECT_EQ(counters[0]["data"]["daemon"]["bytes"], 1LL << 40);
  EXPECT_EQ(counters[0]["data"]["sources"]["tof/helios"]["frames"], 3);
  EXPECT_EQ(of_topic(read, "/PHAROS_LIGHTHOUSE_BEARINGS")[0]["data"]["bearings"][2]["raw_theta_rad"], 1.52);
  EXPECT_EQ(of_topic(read, "/PHAROS_LINE_POINTING").size(), 1U);
  EXPECT_EQ(of_topic(read, "/PHAROS_SLAM_SPIN").size(), 1U);
  EXPECT_EQ(of_topic(read, "/PHAROS_CLOCK").size(), 1U);
  const auto states = of_topic(read, "/PHAROS_TARGET_STATE");
  ASSERT_EQ(states.size(), 2U);
  EXPECT_EQ(states[0]["data"]["covariance"][143], some_state().covariance[143]);
  EXPECT_EQ(states[0]["data"]["sources"][0]["reason"], "step");
  const auto of_states = of_topic(read, "/PHAROS_TARGET_STATE/transform");
  ASSERT_EQ(of_states.size(), 1U) << "without the conflict";
  EXPECT_EQ(of_states[0]["data"]["parent_frame_id"], "fusion/vehicle");
  EXPECT_EQ(of_states[0]["data"]["translation"]["z"], 2.5);
  expect_pictures(read);
}

}  // namespace pharos::test
