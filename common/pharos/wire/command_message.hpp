// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "pharos/wire/bytes.hpp"
#include "pharos/wire/message_type.hpp"

namespace pharos::wire {

/// Request of the host to the running target. Reply: Ack (value as named) or Nak.
enum class CommandCode : std::uint8_t {
  kIdentify = 1,     // send a Hello; ack value 0
  kSetModes = 2,     // value: HelloMode bits wanted; ack value: those now in force
  kReset = 3,        // restart; the ack comes before
  kEnterLoader = 4,  // start the loader, which leaves after a minute of silence; the ack comes before
};

struct Command {
  static constexpr MessageType kType = MessageType::kCommand;
  static constexpr std::size_t kMaxBytes = 5;

  CommandCode code = CommandCode::kIdentify;  // unknown codes pass: the target replies Nak kUnsupported
  std::uint32_t value = 0;
};

/// Done: `value` as defined for the request.
struct Ack {
  static constexpr MessageType kType = MessageType::kAck;
  static constexpr std::size_t kMaxBytes = 7;

  std::uint8_t for_type = 0;  // type number of the request
  std::uint16_t for_sequence = 0;
  std::uint32_t value = 0;
};

enum class NakReason : std::uint8_t {
  kUnsupported = 1,    // unknown command or type
  kBadPayload = 2,     // the payload is invalid, or the image cannot run here
  kOutOfOrder = 3,     // an offset that is not the next; value: the offset expected, or kNothingBegun
  kTooLarge = 4,       // does not fit; value: bytes available
  kWrongBoard = 5,     // an image for another board
  kBadCrc = 6,         // the image does not verify; value: the CRC found
  kWriteFailed = 7,    // writing the memory failed; value: the offset
  kNotVerified = 8,    // start before a good verify
  kNotSigned = 9,      // an image without signature, and no jumper says development
  kBadSignature = 10,  // forged, changed, or signed with another key
  kTooOld = 11,        // older than the floor; value: the floor, major << 16 | minor << 8 | patch
  kNoVerifier = 12,    // the verifier in the target's flash is missing or damaged
};

/// Value of kOutOfOrder where no image was announced.
inline constexpr std::uint32_t kNothingBegun = 0xFFFFFFFF;

/// Not done, and why.
struct Nak {
  static constexpr MessageType kType = MessageType::kNak;
  static constexpr std::size_t kMaxBytes = 8;

  std::uint8_t for_type = 0;
  std::uint16_t for_sequence = 0;
  NakReason reason = NakReason::kUnsupported;
  std::uint32_t value = 0;
};

void write(const Command& message, ByteWriter& out);
void read(ByteReader& in, Command& message);
void write(const Ack& message, ByteWriter& out);
void read(ByteReader& in, Ack& message);
void write(const Nak& message, ByteWriter& out);
void read(ByteReader& in, Nak& message);

}  // namespace pharos::wire
