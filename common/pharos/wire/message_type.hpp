// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace pharos::wire {

/// Version of the protocol implemented here: the meaning of types and payloads. The bytes around the payload
/// (delimiters, byte stuffing, version byte first, CRC-32 last) are the same in every version, so that a receiver of
/// one version recognises a sender of another and can report it.
inline constexpr std::uint8_t kProtocolVersion = 1;

// Every message type, once. A published payload never changes: anything new gets a new type, and receivers skip (and
// count) unknown types. X(Name, number)
#define PHAROS_MESSAGE_TYPES(X) \
  X(Hello, 0x01)                \
  X(Counters, 0x02)             \
  X(Time, 0x03)                 \
  X(Sweep, 0x10)                \
  X(Ootx, 0x11)                 \
  X(Pose, 0x12)                 \
  X(RawEdges, 0x13)             \
  X(Lh2Sweep, 0x14)             \
  X(Lh2Ootx, 0x15)              \
  X(Command, 0x30)              \
  X(LoaderQuery, 0x40)          \
  X(LoaderInfo, 0x41)           \
  X(LoaderBegin, 0x42)          \
  X(LoaderData, 0x43)           \
  X(LoaderVerify, 0x44)         \
  X(LoaderStart, 0x45)          \
  X(Ack, 0x46)                  \
  X(Nak, 0x47)

/// Content of a frame.
enum class MessageType : std::uint8_t {
#define PHAROS_X(name, number) k##name = number,
  PHAROS_MESSAGE_TYPES(PHAROS_X)
#undef PHAROS_X
};

constexpr bool is_known(MessageType type) {
  switch (type) {
#define PHAROS_X(name, number) case MessageType::k##name:
    PHAROS_MESSAGE_TYPES(PHAROS_X)
#undef PHAROS_X
    return true;
  }
  return false;
}

/// "Sweep", …; "unknown" for other types.
constexpr const char* name_of(MessageType type) {
  switch (type) {
#define PHAROS_X(name, number) \
  case MessageType::k##name:   \
    return #name;
    PHAROS_MESSAGE_TYPES(PHAROS_X)
#undef PHAROS_X
  }
  return "unknown";
}

}  // namespace pharos::wire
