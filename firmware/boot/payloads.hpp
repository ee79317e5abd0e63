// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "pharos/boot_image/boot_image_header.hpp"
#include "pharos/wire/command_message.hpp"
#include "pharos/wire/hello_message.hpp"
#include "pharos/wire/loader_messages.hpp"

namespace pharos::boot {

// The payloads that the loader reads and writes, as they lie in a frame (proto/README.md). wire's codec would take half
// of the loader's 4 KiB; the tests of this room compare each of these with that codec.

struct [[gnu::packed, gnu::aligned(4)]] HelloPayload {
  wire::Role role;
  std::uint8_t reset_cause;
  std::uint8_t modes;
  boot_image::Version firmware;
  std::uint16_t start_count;
  std::uint32_t tick_rate_hz;
  std::uint32_t sensors;
  std::uint32_t time_ticks;
  std::uint32_t time_ticks_high;
  std::uint32_t unique_id;
  std::array<char, 24> board;
  std::array<char, 24> target;
};
static_assert(sizeof(HelloPayload) == wire::Hello::kMaxBytes);

struct [[gnu::packed, gnu::aligned(4)]] InfoPayload {
  std::uint16_t loader_version;
  std::uint16_t block_bytes;
  std::uint32_t slot_offset;
  std::uint32_t capacity_bytes;
  std::array<char, 24> board;
};
static_assert(sizeof(InfoPayload) == wire::LoaderInfo::kMaxBytes);

struct [[gnu::packed, gnu::aligned(4)]] BeginPayload {
  std::uint32_t image_bytes;
  std::uint32_t image_crc32;
  std::array<char, 24> board;
};
static_assert(sizeof(BeginPayload) == wire::LoaderBegin::kMaxBytes);

/// Before the data itself.
struct [[gnu::packed, gnu::aligned(2)]] DataHead {
  std::uint32_t offset;
  std::uint16_t bytes;
};

/// Nak; an Ack is the same without the reason.
struct [[gnu::packed]] NakPayload {
  std::uint8_t for_type;
  std::uint16_t for_sequence;
  std::uint8_t reason;
  std::uint32_t value;
};
static_assert(sizeof(NakPayload) == wire::Nak::kMaxBytes);

/// A payload as its bytes; valid as long as it.
template <class Payload>
std::span<const std::uint8_t> bytes_of(const Payload& payload) {
  return {reinterpret_cast<const std::uint8_t*>(&payload), sizeof payload};
}

}  // namespace pharos::boot
