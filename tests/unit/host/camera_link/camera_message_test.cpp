// SPDX-License-Identifier: Apache-2.0
#include "host/camera_link/camera_message.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace pharos::host {
namespace {

FrameNotice some_notice() {
  FrameNotice notice;
  notice.sequence = 77;
  notice.has_depth = true;
  notice.about.width_px = 640;
  notice.about.height_px = 480;
  notice.about.session = 3;
  notice.about.camera_ns = 1'000'000'000'123;
  notice.about.arrival_utc_ns = 1'700'000'000'000'000'000;
  notice.about.arrival_monotonic_ns = 5'000'000'000;
  notice.about.complete_monotonic_ns = 5'013'000'000;
  notice.about.clock = CameraClock::kPtp;
  notice.about.scale = CoordinateScale{{0.001, 0.001, 0.00025}, {-8.0, -8.0, 0.0}};
  return notice;
}

template <class Message>
std::optional<Message> through(const Message& message) {
  const auto decoded = decode_camera_message(encode(message));
  if (!decoded || !std::holds_alternative<Message>(*decoded)) return std::nullopt;
  return std::get<Message>(*decoded);
}

template <class Change>
bool passes(Change change) {
  FrameNotice notice = some_notice();
  change(notice);
  return through(notice).has_value();
}

TEST(CameraMessage, AFrameNoticeComesThrough) {
  const auto notice = through(some_notice());
  ASSERT_TRUE(notice);
  EXPECT_EQ(notice->sequence, 77U);
  EXPECT_TRUE(notice->has_depth);
  EXPECT_EQ(notice->about.width_px, 640);
  EXPECT_EQ(notice->about.camera_ns, 1'000'000'000'123);
  EXPECT_EQ(notice->about.complete_monotonic_ns, 5'013'000'000);
  EXPECT_EQ(notice->about.clock, CameraClock::kPtp);
  EXPECT_FALSE(notice->about.taken_in_turns);
  EXPECT_EQ(notice->about.scale->scale_m[2], 0.00025);
}

TEST(CameraMessage, AnOrderAndAReportComeThrough) {
  CameraOrder order{42, {}};
  order.settings.serial = "233300001";
  order.settings.mode = "Distance5000mmMultiFreq";
  order.settings.format = CameraFormat::kMono16;
  order.settings.width_px = 1280;
  order.settings.height_px = 1024;
  order.settings.ptp = false;
  const auto same = through(order);
  ASSERT_TRUE(same);
  EXPECT_EQ(same->parent_pid, 42);
  EXPECT_EQ(same->settings.serial, order.settings.serial);
  EXPECT_EQ(same->settings.mode, order.settings.mode);
  EXPECT_EQ(same->settings.format, CameraFormat::kMono16);
  EXPECT_EQ(same->settings.height_px, 1024);
  EXPECT_FALSE(same->settings.ptp);

  CameraReport report{CameraState::kTaken, 5, {}, "LUCID", "another program controls it"};
  report.counters.frames_received = 123;
  report.counters.datagrams_discarded = 456;
  report.ptp = PtpState::kUnread;
  report.ptp_lost = true;
  const auto told = through(report);
  ASSERT_TRUE(told);
  EXPECT_EQ(told->state, CameraState::kTaken);
  EXPECT_EQ(told->counters.frames_received, 123);
  EXPECT_EQ(told->counters.datagrams_discarded, 456);
  EXPECT_EQ(told->error, report.error);
  EXPECT_EQ(told->ptp, PtpState::kUnread);
  EXPECT_TRUE(told->ptp_lost);
}

TEST(CameraMessage, TextsAreCutAndHoldNothingThatALogWouldMindAbout) {
  const auto words = through(LastWords{"a\nb\033[2Jc\xFF" + std::string(3 * kMaxCameraText_bytes, 'x')});
  ASSERT_TRUE(words);
  EXPECT_EQ(words->text.size(), kMaxCameraText_bytes);
  EXPECT_EQ(words->text.substr(0, 9), "a?b?[2Jc?");
}

TEST(CameraMessage, WhatCannotBeIsRefused) {
  EXPECT_TRUE(passes([](FrameNotice&) {}));
  EXPECT_FALSE(passes([](FrameNotice& n) { n.sequence = 0; }));
  EXPECT_FALSE(passes([](FrameNotice& n) { n.about.width_px = 0; }));
  EXPECT_FALSE(passes([](FrameNotice& n) { n.about.height_px = -480; }));
  EXPECT_FALSE(passes([](FrameNotice& n) { n.about.height_px = kMaxFrameSide_px + 1; }));
  EXPECT_FALSE(passes([](FrameNotice& n) { n.about.camera_ns = -1; }));
  EXPECT_FALSE(passes([](FrameNotice& n) { n.about.arrival_utc_ns = std::numeric_limits<std::int64_t>::max(); }));
  EXPECT_FALSE(passes([](FrameNotice& n) { n.about.arrival_monotonic_ns = std::int64_t{1} << 60; }));
  EXPECT_FALSE(passes([](FrameNotice& n) { n.about.scale->scale_m[0] = std::nan(""); }));
  EXPECT_FALSE(passes([](FrameNotice& n) { n.about.scale->offset_m[1] = 1e300; }));
}

TEST(CameraMessage, AFlippedBitACutOrAnAddedByteIsRefused) {
  const std::vector<std::uint8_t> good = encode(some_notice());
  for (std::size_t bit = 0; bit < 8 * good.size(); ++bit) {
    std::vector<std::uint8_t> bad = good;
    bad[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
    EXPECT_FALSE(decode_camera_message(bad)) << "bit " << bit;
  }
  for (std::size_t size = 0; size < good.size(); ++size) {
    EXPECT_FALSE(decode_camera_message(std::span(good).first(size)));
  }
  std::vector<std::uint8_t> longer = good;
  longer.push_back(0);
  EXPECT_FALSE(decode_camera_message(longer));
}

}  // namespace
}  // namespace pharos::host
