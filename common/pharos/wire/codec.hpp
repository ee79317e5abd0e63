// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "pharos/base/result.hpp"
#include "pharos/wire/bytes.hpp"

namespace pharos::wire {

// Every message is a plain struct M with `M::kType` (MessageType) and `M::kMaxBytes` (its longest payload), and two
// free functions in its header: `write(const M&, ByteWriter&)` and `read(ByteReader&, M&)`. Equal structs are equal
// bytes and vice versa: decoders accept only what an encoder would have written.

/// Why a payload is not a valid message.
enum class DecodeError : std::uint8_t {
  kNone,
  kTooShort,       // it ends within a field
  kTrailingBytes,  // bytes are left over
  kBadValue,       // a field with an invalid value (a number out of range, a reserved bit set, NaN)
};

/// Returns the bytes of the payload written; 0 when it does not fit or a field is out of its range.
template <class M>
std::size_t encode_payload(const M& message, std::span<std::uint8_t> out) {
  ByteWriter writer(out);
  write(message, writer);
  return writer.size();
}

template <class M>
Result<M, DecodeError> decode_payload(std::span<const std::uint8_t> payload) {
  M message;
  ByteReader reader(payload);
  read(reader, message);
  if (reader.ran_short()) return DecodeError::kTooShort;
  if (reader.refused()) return DecodeError::kBadValue;
  if (reader.remaining() > 0) return DecodeError::kTrailingBytes;
  return message;
}

}  // namespace pharos::wire
