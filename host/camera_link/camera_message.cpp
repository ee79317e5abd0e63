// SPDX-License-Identifier: Apache-2.0
#include "host/camera_link/camera_message.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "pharos/wire/bytes.hpp"
#include "pharos/wire/crc32.hpp"

namespace pharos::host {
namespace {

using wire::ByteReader;
using wire::ByteWriter;

constexpr std::uint32_t kMagic = 0x4D434850;  // "PHCM"
// An update may install pharos-camera in another version than the running daemon's: both refuse such messages and
// report it.
constexpr std::uint16_t kVersion = 2;
constexpr std::size_t kHead_bytes = 12;

enum class Kind : std::uint16_t { kOrder = 1, kFrame = 2, kReport = 3, kLastWords = 4 };

// Times are ns since boot, since 1970 or since the camera's start. They are limited to 146 years, so that no difference
// of two can overflow.
constexpr std::int64_t kMaxTime_ns = std::int64_t{1} << 62;
// Maximum time from a frame's first packet to its last.
constexpr std::int64_t kMaxTransport_ns = 60'000'000'000;
// One count of depth is micrometres to millimetres; offsets are some thousand counts.
constexpr double kMaxScale_m = 1.0;
constexpr double kMaxOffset_m = 1e5;
constexpr std::int32_t kMaxPacket_bytes = 65'535;
constexpr double kMaxRate_hz = 1e4;

enum FrameFlag : std::uint8_t { kHasDepth = 1, kInTurns = 2, kFollowsPtp = 4, kHasScale = 8 };
constexpr std::uint8_t kFrameFlags = kHasDepth | kInTurns | kFollowsPtp | kHasScale;

bool printable(char character) { return character >= ' ' && character <= '~'; }

// Vendor and model are text from the camera: characters other than printable ASCII are shown as '?'.
void put_text(ByteWriter& writer, std::string text) {
  text.resize(std::min(text.size(), kMaxCameraText_bytes));
  std::replace_if(
      text.begin(), text.end(), [](char character) { return !printable(character); }, '?');
  writer.put(static_cast<std::uint16_t>(text.size()));
  writer.put_bytes({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

std::string get_text(ByteReader& reader) {
  const auto size = reader.get<std::uint16_t>();
  reader.refuse_if(size > kMaxCameraText_bytes);
  if (reader.refused() || size > reader.remaining()) {
    reader.refuse();
    return "";
  }
  std::string text(size, '\0');
  reader.get_bytes({reinterpret_cast<std::uint8_t*>(text.data()), text.size()});
  reader.refuse_if(!std::all_of(text.begin(), text.end(), printable));
  return text;
}

template <class Enum>
Enum get_enum(ByteReader& reader, Enum last) {
  const auto value = reader.get<std::uint8_t>();
  reader.refuse_if(value > static_cast<std::uint8_t>(last));
  return reader.refused() ? Enum{} : static_cast<Enum>(value);
}

std::int32_t get_between(ByteReader& reader, std::int32_t min, std::int32_t max) {
  const auto value = reader.get<std::int32_t>();
  reader.refuse_if(value < min || value > max);
  return value;
}

std::int64_t get_time(ByteReader& reader) {
  const auto time_ns = reader.get<std::int64_t>();
  reader.refuse_if(time_ns < 0 || time_ns > kMaxTime_ns);
  return time_ns;
}

double get_within(ByteReader& reader, double max) {
  const auto value = reader.get_finite<double>();
  reader.refuse_if(std::abs(value) > max);
  return value;
}

void put(ByteWriter& writer, const CameraOrder& order) {
  const CameraSettings& settings = order.settings;
  writer.put(order.parent_pid);
  writer.put(settings.width_px);
  writer.put(settings.height_px);
  writer.put(static_cast<std::int32_t>(settings.packet_size));
  writer.put(settings.frame_rate_hz);
  writer.put(static_cast<std::uint8_t>(settings.format));
  writer.put(static_cast<std::uint8_t>(settings.ptp));
  put_text(writer, settings.serial);
  put_text(writer, settings.address);
  put_text(writer, settings.mode);
}

CameraOrder get_order(ByteReader& reader) {
  CameraOrder order;
  CameraSettings& settings = order.settings;
  order.parent_pid = get_between(reader, 1, std::numeric_limits<std::int32_t>::max());
  settings.width_px = get_between(reader, 1, kMaxFrameSide_px);
  settings.height_px = get_between(reader, 1, kMaxFrameSide_px);
  settings.packet_size = get_between(reader, 1, kMaxPacket_bytes);
  settings.frame_rate_hz = get_within(reader, kMaxRate_hz);
  settings.format = get_enum(reader, CameraFormat::kMono16);
  settings.ptp = get_enum<std::uint8_t>(reader, 1) != 0;
  settings.serial = get_text(reader);
  settings.address = get_text(reader);
  settings.mode = get_text(reader);
  return order;
}

void put(ByteWriter& writer, const FrameNotice& notice) {
  const DepthFrame& frame = notice.about;
  writer.put(notice.sequence);
  writer.put(frame.width_px);
  writer.put(frame.height_px);
  writer.put(frame.session);
  writer.put(frame.camera_ns);
  writer.put(frame.arrival_utc_ns);
  writer.put(frame.arrival_monotonic_ns);
  writer.put(frame.complete_monotonic_ns);
  writer.put(static_cast<std::uint8_t>((notice.has_depth ? kHasDepth : 0) | (frame.taken_in_turns ? kInTurns : 0) |
                                       (frame.clock == CameraClock::kPtp ? kFollowsPtp : 0) |
                                       (frame.scale ? kHasScale : 0)));
  if (!frame.scale) return;
  for (const double scale_m : frame.scale->scale_m) writer.put(scale_m);
  for (const double offset_m : frame.scale->offset_m) writer.put(offset_m);
}

FrameNotice get_frame(ByteReader& reader) {
  FrameNotice notice;
  DepthFrame& frame = notice.about;
  notice.sequence = reader.get<std::uint64_t>();
  reader.refuse_if(notice.sequence == 0);
  frame.width_px = get_between(reader, 1, kMaxFrameSide_px);
  frame.height_px = get_between(reader, 1, kMaxFrameSide_px);
  frame.session = reader.get<std::uint32_t>();
  frame.camera_ns = get_time(reader);
  frame.arrival_utc_ns = get_time(reader);
  frame.arrival_monotonic_ns = get_time(reader);
  frame.complete_monotonic_ns = get_time(reader);
  const std::int64_t transport_ns = frame.complete_monotonic_ns - frame.arrival_monotonic_ns;
  reader.refuse_if(std::abs(transport_ns) > kMaxTransport_ns);
  const auto flags = reader.get<std::uint8_t>();
  reader.refuse_if((flags & ~kFrameFlags) != 0);
  notice.has_depth = (flags & kHasDepth) != 0;
  frame.taken_in_turns = (flags & kInTurns) != 0;
  frame.clock = (flags & kFollowsPtp) != 0 ? CameraClock::kPtp : CameraClock::kOwn;
  if ((flags & kHasScale) == 0) return notice;
  CoordinateScale& scale = frame.scale.emplace();
  for (double& scale_m : scale.scale_m) scale_m = get_within(reader, kMaxScale_m);
  for (double& offset_m : scale.offset_m) offset_m = get_within(reader, kMaxOffset_m);
  return notice;
}

void put(ByteWriter& writer, const CameraReport& report) {
  writer.put(static_cast<std::uint8_t>(report.state));
  writer.put(report.session);
  for_each_counter(report.counters, [&](const char*, std::int64_t value) { writer.put(value); });
  put_text(writer, report.identity);
  put_text(writer, report.error);
  writer.put(static_cast<std::uint8_t>(report.ptp));
  writer.put(static_cast<std::uint8_t>(report.ptp_lost));
}

CameraReport get_report(ByteReader& reader) {
  CameraReport report;
  report.state = get_enum(reader, CameraState::kWrong);
  report.session = reader.get<std::uint32_t>();
  for_each_counter(report.counters, [&](const char*, std::int64_t& value) { value = get_time(reader); });
  report.identity = get_text(reader);
  report.error = get_text(reader);
  report.ptp = get_enum(reader, PtpState::kUnread);
  report.ptp_lost = get_enum<std::uint8_t>(reader, 1) != 0;
  return report;
}

void put(ByteWriter& writer, const LastWords& words) { put_text(writer, words.text); }

Kind kind_of(const CameraMessage& message) { return static_cast<Kind>(message.index() + 1); }

std::optional<CameraMessage> get_body(Kind kind, ByteReader& reader) {
  switch (kind) {
    case Kind::kOrder:
      return get_order(reader);
    case Kind::kFrame:
      return get_frame(reader);
    case Kind::kReport:
      return get_report(reader);
    case Kind::kLastWords:
      return LastWords{get_text(reader)};
  }
  return std::nullopt;
}

}  // namespace

std::vector<std::uint8_t> encode(const CameraMessage& message) {
  std::array<std::uint8_t, kMaxCameraMessage_bytes> buffer{};
  ByteWriter body({buffer.data() + kHead_bytes, buffer.size() - kHead_bytes});
  std::visit([&](const auto& content) { put(body, content); }, message);
  ByteWriter head(buffer);
  head.put(kMagic);
  head.put(kVersion);
  head.put(static_cast<std::uint16_t>(kind_of(message)));
  // The CRC covers the kind too.
  head.put(
      wire::crc32(std::span(buffer).subspan(kHead_bytes, body.size()), static_cast<std::uint32_t>(kind_of(message))));
  return {buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(kHead_bytes + body.size())};
}

std::optional<CameraMessage> decode_camera_message(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kHead_bytes || bytes.size() > kMaxCameraMessage_bytes) return std::nullopt;
  ByteReader head(bytes);
  if (head.get<std::uint32_t>() != kMagic || head.get<std::uint16_t>() != kVersion) return std::nullopt;
  const auto kind = head.get<std::uint16_t>();
  const std::span body = bytes.subspan(kHead_bytes);
  if (head.get<std::uint32_t>() != wire::crc32(body, kind)) return std::nullopt;
  ByteReader reader(body);
  std::optional<CameraMessage> message = get_body(static_cast<Kind>(kind), reader);
  if (reader.ran_short() || reader.refused() || reader.remaining() != 0) return std::nullopt;
  return message;
}

}  // namespace pharos::host
