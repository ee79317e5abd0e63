// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include "pharos/wire/frame_decoder.hpp"
#include "unit/wire/random_messages.hpp"

namespace pharos::wire {
namespace {

using test::Bytes;

struct Golden {
  std::string name;
  MessageType type;
  std::uint16_t sequence;
  Bytes line;
};

std::vector<Golden> golden_frames() {
  std::vector<Golden> frames;
  std::ifstream file(PHAROS_PROTO_DIR "/golden_frames.txt");
  for (std::string row; std::getline(file, row);) {
    if (row.empty() || row[0] == '#') continue;
    std::istringstream fields(row);
    Golden golden;
    std::string type;
    std::string hex;
    fields >> golden.name >> type >> golden.sequence >> hex;
    golden.type = static_cast<MessageType>(std::stoul(type, nullptr, 16));
    for (std::size_t i = 0; i + 1 < hex.size(); i += 2) {
      golden.line.push_back(static_cast<std::uint8_t>(std::stoul(hex.substr(i, 2), nullptr, 16)));
    }
    frames.push_back(golden);
  }
  return frames;
}

const Golden& golden(const std::vector<Golden>& frames, const std::string& name) {
  for (const Golden& frame : frames) {
    if (frame.name == name) return frame;
  }
  throw std::runtime_error("no golden frame " + name);
}

template <class M>
M decode_golden(const std::string& name) {
  static const auto frames = golden_frames();
  FrameDecoder decoder;
  for (const std::uint8_t byte : golden(frames, name).line) {
    if (const auto frame = decoder.push(byte)) {
      const auto message = decode_payload<M>(frame->payload);
      EXPECT_TRUE(message.ok());
      return *message;
    }
  }
  ADD_FAILURE() << name << " does not decode";
  return {};
}

TEST(GoldenFrames, DecodeAndEncodeByteForByte) {
  const auto frames = golden_frames();
  std::set<MessageType> types;
  FrameDecoder decoder;  // one stream: consecutive numbers
  FrameEncoder encoder;
  for (const Golden& golden : frames) {
    std::size_t found = 0;
    for (const std::uint8_t byte : golden.line) {
      const auto frame = decoder.push(byte);
      if (!frame) continue;
      ++found;
      EXPECT_EQ(frame->type, golden.type) << golden.name;
      EXPECT_EQ(frame->sequence, golden.sequence) << golden.name;
      ASSERT_TRUE(test::visit_type(frame->type, [&](auto example) {
        const auto message = decode_payload<decltype(example)>(frame->payload);
        ASSERT_TRUE(message.ok()) << golden.name;
        Bytes payload(kMaxPayload);
        payload.resize(encode_payload(*message, payload));
        EXPECT_EQ(test::frame_bytes(encoder, decltype(example)::kType, payload), golden.line) << golden.name;
      }));
    }
    EXPECT_EQ(found, 1u) << golden.name;
    types.insert(golden.type);
  }
  EXPECT_EQ(types.size(), test::AllMessages::kSize) << "every type has a golden frame";
  EXPECT_EQ(decoder.counters().frames_lost, 0u);
}

TEST(GoldenFrames, MeanWhatTheByteTablesSay) {
  const auto sweep = decode_golden<Sweep>("sweep");
  EXPECT_EQ(sweep.flash_start_ticks, 4294967296);
  EXPECT_EQ(sweep.flash_length_ticks, 3125);
  EXPECT_EQ(sweep.period_sixteenth_ticks, 13333340u);
  EXPECT_EQ(sweep.flash_sensors, 9);
  EXPECT_EQ(sweep.flags, 1);
  EXPECT_EQ(sweep.station, 0);
  EXPECT_EQ(sweep.axis, Axis::kY);
  EXPECT_TRUE(sweep.data);
  EXPECT_FALSE(sweep.skip);
  ASSERT_EQ(sweep.hits.size(), 4u);
  EXPECT_EQ(sweep.hits[2], (SweepHit{31, 7500, 0}));

  const auto hello = decode_golden<Hello>("hello");
  EXPECT_EQ(hello.reset_cause, ResetCause::kPowerOn);
  EXPECT_EQ(hello.firmware_minor, 1);
  EXPECT_EQ(hello.start_count, 7);
  EXPECT_EQ(hello.tick_rate_hz, 50'000'000u);
  EXPECT_EQ(hello.sensors, 0xFFFu);
  EXPECT_EQ(hello.board.view(), "virtual-rv32");
  EXPECT_EQ(hello.target.view(), "chaser");

  const auto pose = decode_golden<Pose>("pose_ambiguous");
  ASSERT_TRUE(pose.answer && pose.answer->second);
  EXPECT_EQ(pose.station, 1);
  EXPECT_EQ(pose.observations, 8);
  EXPECT_EQ(pose.answer->pose.orientation_wxyz, (std::array{0.5, -0.5, 0.5, 0.5}));
  EXPECT_EQ(pose.answer->pose.position_m, (std::array{0.125, -0.25, 3.0}));
  EXPECT_EQ(pose.answer->covariance[20], 21.0F / 64.0F);
  EXPECT_EQ(pose.answer->pdop_m_per_rad, 56.25F);
  EXPECT_EQ(pose.answer->second->pose.position_m[2], 2.5);
  EXPECT_EQ(pose.answer->second->delta_chi2, 2.5F);

  const auto edges = decode_golden<RawEdges>("raw_edges");
  ASSERT_EQ(edges.edges.size(), 6u);
  EXPECT_EQ(edges.edges_lost, 2u);
  EXPECT_EQ(edges.edges[2], (RawEdge{1005, 31, true}));
  EXPECT_EQ(edges.edges[5], (RawEdge{420000, 31, false}));

  const auto nak = decode_golden<Nak>("nak");
  EXPECT_EQ(nak.for_sequence, 17);
  EXPECT_EQ(nak.reason, NakReason::kOutOfOrder);
  EXPECT_EQ(nak.value, 768u);
}

}  // namespace
}  // namespace pharos::wire
