// SPDX-License-Identifier: Apache-2.0
#include "host/record/stream_reader.hpp"

#include <algorithm>

#include "host/support/input_error.hpp"
#include "pharos/wire/bytes.hpp"
#include "pharos/wire/crc32.hpp"

namespace pharos::host {
namespace {

using namespace stream_format;

/// Half of what 64 bits hold, year 2116: sums and differences of such times cannot overflow.
constexpr std::int64_t kLatest_ns = std::int64_t{1} << 62;

bool in_bounds(std::int64_t time_ns) { return time_ns >= 0 && time_ns < kLatest_ns; }

bool has_good_crc(std::span<const std::uint8_t> bytes) {
  const auto crc = wire::ByteReader(bytes.last(kCrcBytes)).get<std::uint32_t>();
  return crc == wire::crc32(bytes.first(bytes.size() - kCrcBytes));
}

}  // namespace

StreamReader::StreamReader(ByteSource source) : in_(std::move(source)) { read_header(); }

bool StreamReader::looks_like(std::string_view first_bytes) {
  return first_bytes.size() >= kMagic.size() &&
         std::equal(kMagic.begin(), kMagic.end(), first_bytes.begin(),
                    [](std::uint8_t wanted, char is) { return wanted == static_cast<std::uint8_t>(is); });
}

void StreamReader::read_header() {
  const std::string& file = in_.name();
  if (!in_.have(kHeadBytes) || !std::equal(kMagic.begin(), kMagic.end(), in_.ahead(kMagic.size()).begin())) {
    throw InputError(file + ": is not a recorded serial stream; those are made by pharosd's [recording]");
  }
  wire::ByteReader reader(in_.ahead(kHeadBytes).subspan(kMagic.size()));
  const auto version = reader.get<std::uint8_t>();
  if (version != kVersion) {
    throw InputError(file + ": recorded in format version " + std::to_string(version) +
                     ", this program reads version " + std::to_string(kVersion) +
                     "; use the Pharos release that recorded it");
  }
  const std::size_t name = reader.get<std::uint8_t>();
  const std::size_t whole = kHeadBytes + name + kCrcBytes;
  if (!in_.have(whole) || !has_good_crc(in_.ahead(whole))) {
    throw InputError(file + ": the head of this recording is damaged; nothing can be said of what follows");
  }
  header_.baud = reader.get<std::uint32_t>();
  header_.utc_ns = reader.get<std::int64_t>();
  header_.monotonic_ns = reader.get<std::int64_t>();
  if (!in_bounds(header_.utc_ns) || !in_bounds(header_.monotonic_ns)) {
    throw InputError(file + ": the head of this recording tells impossible times; no pharosd made it");
  }
  last_monotonic_ns_ = header_.monotonic_ns;
  const auto letters = in_.ahead(whole).subspan(kHeadBytes, name);
  header_.target.assign(letters.begin(), letters.end());
  in_.use(whole);
}

/// Size of the complete, valid chunk that begins here; 0 when there is none.
std::size_t StreamReader::whole_chunk_size() {
  if (!in_.have(kChunkHeadBytes)) return 0;
  wire::ByteReader reader(in_.ahead(kChunkHeadBytes));
  const auto mark = reader.get<std::uint8_t>();
  const std::size_t count = reader.get<std::uint16_t>();
  if (mark != kDataMark && !(mark == kLossMark && count == sizeof(std::uint64_t))) return 0;
  if (count > kMaxChunkBytes) return 0;
  const std::size_t whole = kChunkHeadBytes + count + kCrcBytes;
  return in_.have(whole) && has_good_crc(in_.ahead(whole)) ? whole : 0;
}

bool StreamReader::credible(const StreamChunk& chunk) const {
  return in_bounds(chunk.utc_ns) && in_bounds(chunk.monotonic_ns) && chunk.monotonic_ns >= last_monotonic_ns_ &&
         chunk.monotonic_ns - last_monotonic_ns_ <= kLongestSilence_ns;
}

std::optional<StreamChunk> StreamReader::next() {
  std::uint64_t lost_before = 0;
  std::uint64_t skipped = 0;
  while (in_.have(1)) {
    const std::size_t whole = whole_chunk_size();
    if (whole == 0) {
      in_.use(1);
      ++skipped;
      continue;
    }
    dropped_bytes_ += skipped;
    skipped = 0;
    const auto bytes = in_.ahead(whole);
    in_.use(whole);
    wire::ByteReader reader(bytes);
    const bool is_loss = reader.get<std::uint8_t>() == kLossMark;
    reader.get<std::uint16_t>();
    StreamChunk chunk;
    chunk.utc_ns = reader.get<std::int64_t>();
    chunk.monotonic_ns = reader.get<std::int64_t>();
    if (is_loss) {
      const auto lost = reader.get<std::uint64_t>();
      lost_before += lost;
      lost_bytes_ += lost;
      continue;
    }
    chunk.bytes = bytes.subspan(kChunkHeadBytes, whole - kChunkHeadBytes - kCrcBytes);
    if (!credible(chunk)) {
      ++bad_times_;
      lost_before += chunk.bytes.size();
      continue;
    }
    chunk.lost_before = lost_before;
    last_monotonic_ns_ = chunk.monotonic_ns;
    return chunk;
  }
  dropped_bytes_ += skipped;
  cut_off_ = cut_off_ || skipped > 0 || in_.cut_off();
  return std::nullopt;
}

}  // namespace pharos::host
