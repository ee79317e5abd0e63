// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

namespace pharos {
class bearings_t;
class clock_exchange_t;
class pointing_t;
class pose_t;
class preview_t;
class spin_t;
class status_t;
class target_state_t;
}  // namespace pharos

namespace pharos::host {

/// The layout of an LCM type after its fingerprint, in the order of its .lcm file: a number is that many bytes, `s` a
/// text, `( )` a list with its count in front.
///
/// LCM's generated decoders trust every length: a text of negative length or a list of 2^31 entries ends the program or
/// takes all memory. Anyone who reaches the network can send such bytes, so the lengths are checked beforehand.
template <class Message>
inline constexpr std::string_view kMessageShape = "";
template <>
inline constexpr std::string_view kMessageShape<pose_t> = "8 4 4 8 s s 1 s s s s 1 s 24 32 288 16 8 4 4 16 1 24 32 8";
template <>
inline constexpr std::string_view kMessageShape<pointing_t> = "8 8 s s s s 1 s 1 4 48 32 72 8 24 8";
template <>
inline constexpr std::string_view kMessageShape<spin_t> = "8 8 s s s s s 1 24 72 24 16 8 4 8";
template <>
inline constexpr std::string_view kMessageShape<bearings_t> = "8 8 s s 1 s s 1 ( 1 1 8 8 4 4 1 8 )";
template <>
inline constexpr std::string_view kMessageShape<status_t> = "8 8 s s 8 s s ( s 8 ) ( s s s s s s 8 8 8 16 ( s 8 ) )";

template <>
inline constexpr std::string_view kMessageShape<target_state_t> =
    "8 8 s s 1 24 32 24 24 1152 1 1 8 8 8 ( s s s 8 8 ) 1 s s 48 64";

template <>
inline constexpr std::string_view kMessageShape<clock_exchange_t> = "s s 8 8 1 8 8 8";

template <>
inline constexpr std::string_view kMessageShape<preview_t> = "8 8 s s s s s 4 4 s ( 1 )";

/// Whether the bytes begin as a message of the type with this fingerprint.
bool has_fingerprint(const void* data, int size, std::int64_t fingerprint);

/// Whether `size` bytes at `data` are a fingerprint and then exactly the fields of `shape`, each length within them.
bool has_shape(const void* data, int size, std::string_view shape);

/// Whether `data` is a message of this type, and whole; its fields then. Any bytes may come. The type's header from
/// proto/ is the caller's.
template <class Message>
bool decode(Message& message, const void* data, int size) {
  static_assert(!kMessageShape<Message>.empty(), "write the type's shape into message_shape.hpp");
  return has_fingerprint(data, size, Message::getHash()) && has_shape(data, size, kMessageShape<Message>) &&
         message.decode(data, 0, size) == size;
}

}  // namespace pharos::host
