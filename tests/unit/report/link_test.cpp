// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <vector>

#include "pharos/report/convert.hpp"
#include "pharos/report/link_decoder.hpp"
#include "pharos/report/reporter.hpp"
#include "pharos/wire/codec.hpp"
#include "unit/report/samples.hpp"

namespace pharos::report {
namespace {

std::vector<LinkEvent> receive(LinkDecoder& link, Reporter::Bytes bytes) {
  std::vector<LinkEvent> events;
  for (const std::uint8_t byte : bytes) {
    if (const auto event = link.push(byte)) events.push_back(*event);
  }
  return events;
}

template <class T>
T receive_one(LinkDecoder& link, Reporter::Bytes bytes) {
  const auto events = receive(link, bytes);
  EXPECT_EQ(events.size(), 1u);
  const T* value = events.empty() ? nullptr : std::get_if<T>(&events[0]);
  EXPECT_NE(value, nullptr);
  return value == nullptr ? T{} : *value;
}

TEST(Link, CarriesEveryKindOfReport) {
  std::mt19937_64 random(41);
  Reporter reporter;
  LinkDecoder link;
  const auto sweep = test::random_sweep(random, 64);
  test::expect_equal(receive_one<lighthouse::Sweep>(link, reporter.report(sweep)), sweep);

  lighthouse::OotxPayload payload;
  payload.time_ticks = 5;
  payload.station = 1;
  for (std::uint8_t i = 0; i < 33; ++i) payload.bytes.push_back(i);
  const auto got = receive_one<lighthouse::OotxPayload>(link, reporter.report(payload));
  EXPECT_EQ(got.time_ticks, 5);
  EXPECT_EQ(got.station, 1);
  EXPECT_TRUE(std::equal(got.bytes.begin(), got.bytes.end(), payload.bytes.begin(), payload.bytes.end()));

  PoseReport pose;
  pose.pose = test::random_estimate(random, true);
  EXPECT_TRUE(receive_one<PoseReport>(link, reporter.report(pose)).pose.ok());
  DecoderReport decoder;
  decoder.counters.sweeps = 12;
  EXPECT_EQ(receive_one<DecoderReport>(link, reporter.report(decoder)).counters.sweeps, 12u);
  DeviceReport device;
  device.counters.stack_free_bytes = 1234;
  EXPECT_EQ(receive_one<DeviceReport>(link, reporter.report(device)).counters.stack_free_bytes, 1234u);
  EXPECT_EQ(receive_one<wire::Time>(link, reporter.report_time(99)).time_ticks, 99);
  wire::Hello hello;
  hello.board = wire::Text<24>("virtual-rv32");
  EXPECT_EQ(receive_one<wire::Hello>(link, reporter.send(hello)).board.view(), "virtual-rv32");
  receive_one<wire::LoaderVerify>(link, reporter.send(wire::LoaderVerify{}));

  EXPECT_EQ(link.counters().frames, reporter.frames());
  EXPECT_EQ(link.counters().garbage_bytes, 0u);
  EXPECT_EQ(link.counters().bad_payload, 0u);
}

TEST(Link, CarriesEveryEdgeInDiagnosticMode) {
  std::mt19937_64 random(42);
  Reporter reporter;
  LinkDecoder link;
  std::vector<lighthouse::Edge> sent;
  std::vector<lighthouse::Edge> received;
  const auto deliver = [&](Reporter::Bytes bytes) {
    for (const LinkEvent& event : receive(link, bytes)) {
      const auto* report = std::get_if<EdgesReport>(&event);
      ASSERT_NE(report, nullptr);
      EXPECT_EQ(report->edges_lost, 3u);
      received.insert(received.end(), report->edges.begin(), report->edges.end());
    }
  };
  for (std::int64_t i = 0; i < 10'000; ++i) {
    const lighthouse::Edge edge{i * 700 + static_cast<std::int64_t>(random() % 1000),
                                static_cast<std::uint8_t>(random() % 32), random() % 2 == 0};
    sent.push_back(edge);
    deliver(reporter.report(edge, 3));
  }
  deliver(reporter.flush_edges());
  EXPECT_TRUE(reporter.flush_edges().empty());
  ASSERT_EQ(received.size(), sent.size());
  for (std::size_t i = 0; i < sent.size(); ++i) {
    EXPECT_EQ(received[i].stamp_ticks, sent[i].stamp_ticks);
    EXPECT_EQ(received[i].sensor, sent[i].sensor);
    EXPECT_EQ(received[i].rising, sent[i].rising);
  }
}

TEST(Link, CountsAPayloadThatMeansNothing) {
  wire::FrameEncoder encoder;
  std::array<std::uint8_t, wire::kMaxLineFrame> line{};
  const std::array<std::uint8_t, 3> nonsense{1, 2, 3};
  LinkDecoder link;
  const std::size_t size = encoder.encode(wire::MessageType::kSweep, nonsense, line);
  EXPECT_TRUE(receive(link, Reporter::Bytes(line).first(size)).empty());
  EXPECT_EQ(link.counters().bad_payload, 1u);
}

TEST(Link, DropsAndCountsASweepThatNoLightGives) {
  std::mt19937_64 random(43);
  const auto sent = test::random_sweep(random, 12);
  std::array<std::uint8_t, wire::kMaxPayload> payload{};
  const std::size_t payload_size = wire::encode_payload(to_wire(sent), payload);
  ASSERT_GT(payload_size, 0u);
  wire::FrameEncoder encoder;
  std::array<std::uint8_t, wire::kMaxLineFrame> line{};
  LinkDecoder link;
  const auto received = [&] {
    const auto bytes = std::span<const std::uint8_t>(payload).first(payload_size);
    const std::size_t size = encoder.encode(wire::MessageType::kSweep, bytes, line);
    return receive(link, Reporter::Bytes(line).first(size)).size();
  };
  EXPECT_EQ(received(), 1u);
  payload[15] = 0xFF;  // the rotor period becomes 5 s
  EXPECT_EQ(received(), 0u);
  EXPECT_EQ(link.counters().bad_payload, 1u);
}

TEST(Reporter, RefusesWhatCannotBeSentAndCountsIt) {
  Reporter reporter;
  lighthouse::Sweep sweep;
  sweep.flash.station = 7;
  EXPECT_TRUE(reporter.report(sweep).empty());
  EXPECT_TRUE(reporter.report(lighthouse::Edge{0, 40, true}, 0).empty());
  EXPECT_EQ(reporter.refused(), 2u);
  EXPECT_EQ(reporter.frames(), 0u);
}

TEST(Link, NewestTicksIsTheEndOfTheLastLight) {
  lighthouse::Sweep sweep;
  sweep.flash.start_ticks = 1000;
  sweep.flash.length_ticks = 3125;
  EXPECT_EQ(newest_ticks(sweep), 4125);
  sweep.hits.push_back({1, 200, 600'000});
  sweep.hits.push_back({2, 210, 400'001});
  EXPECT_EQ(newest_ticks(sweep), 1000 + 300'000 + 100);
  EXPECT_EQ(newest_ticks(wire::Time{5}), 5);
  EXPECT_EQ(newest_ticks(wire::LoaderVerify{}), std::nullopt);
}

}  // namespace
}  // namespace pharos::report
