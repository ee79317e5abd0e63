// SPDX-License-Identifier: Apache-2.0
#include "host/frame_record/frame_format.hpp"

#include <zlib.h>

#include <algorithm>

#include "pharos/wire/bytes.hpp"

namespace pharos::host::frame_format {
namespace {

using wire::ByteReader;
using wire::ByteWriter;

constexpr std::size_t kMaxName_bytes = 255;
/// Half of what 64 bits hold, year 2116: sums and differences of such times cannot overflow.
constexpr std::int64_t kLatest_ns = std::int64_t{1} << 62;

bool is_time(std::int64_t time_ns) { return time_ns >= 0 && time_ns < kLatest_ns; }
bool is_side(std::int32_t side_px) { return side_px > 0 && side_px <= kMaxFrameSide_px; }

}  // namespace

std::uint32_t crc_of(std::span<const std::uint8_t> bytes, std::uint32_t so_far) {
  return static_cast<std::uint32_t>(::crc32_z(so_far, bytes.data(), bytes.size()));
}

std::vector<std::uint8_t> encode_head(const FramesHeader& header) {
  const std::string name = header.camera.substr(0, kMaxName_bytes);
  std::vector<std::uint8_t> bytes(kHeadBytes + name.size() + kCrcBytes);
  ByteWriter writer(bytes);
  writer.put_bytes(kMagic);
  writer.put(kVersion);
  writer.put(static_cast<std::uint8_t>(name.size()));
  writer.put(static_cast<std::uint8_t>(header.has_depth));
  writer.put(header.width_px);
  writer.put(header.height_px);
  writer.put(header.utc_ns);
  writer.put(header.monotonic_ns);
  writer.put_bytes({reinterpret_cast<const std::uint8_t*>(name.data()), name.size()});
  writer.put(crc_of(std::span(bytes).first(writer.size())));
  return bytes;
}

std::vector<std::uint8_t> encode_notice(const FrameNotice& notice) {
  const std::vector<std::uint8_t> message = encode(notice);
  std::vector<std::uint8_t> bytes(kMarkBytes + message.size());
  ByteWriter writer(bytes);
  writer.put(kFrameMark);
  writer.put(static_cast<std::uint16_t>(message.size()));
  writer.put_bytes(message);
  return bytes;
}

std::size_t head_bytes(std::span<const std::uint8_t> first) {
  if (!std::equal(kMagic.begin(), kMagic.end(), first.begin()) || first[kMagic.size()] != kVersion) return 0;
  return kHeadBytes + first[kMagic.size() + 1] + kCrcBytes;
}

std::optional<FramesHeader> decode_head(std::span<const std::uint8_t> whole) {
  const auto content = whole.first(whole.size() - kCrcBytes);
  if (ByteReader(whole.last(kCrcBytes)).get<std::uint32_t>() != crc_of(content)) return std::nullopt;
  ByteReader reader(content.subspan(kMagic.size() + 2));
  FramesHeader header;
  const auto has_depth = reader.get<std::uint8_t>();
  header.has_depth = has_depth == 1;
  header.width_px = reader.get<std::int32_t>();
  header.height_px = reader.get<std::int32_t>();
  header.utc_ns = reader.get<std::int64_t>();
  header.monotonic_ns = reader.get<std::int64_t>();
  header.camera.assign(content.begin() + kHeadBytes, content.end());
  const bool good = has_depth <= 1 && is_side(header.width_px) && is_side(header.height_px) && is_time(header.utc_ns) &&
                    is_time(header.monotonic_ns);
  return good ? std::optional(header) : std::nullopt;
}

}  // namespace pharos::host::frame_format
