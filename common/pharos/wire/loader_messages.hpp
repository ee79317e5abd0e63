// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "pharos/base/static_vector.hpp"
#include "pharos/wire/bytes.hpp"
#include "pharos/wire/message_type.hpp"
#include "pharos/wire/text.hpp"

namespace pharos::wire {

// Transfer of an image (common/pharos/boot_image) into the target: query -> hello and info, begin, data…, verify,
// start. Every request but the query is answered by Ack or Nak before the next is sent, except data, of which
// kLoaderWindow blocks may be unacknowledged. Repeating a request is harmless.

/// Blocks of data that may be sent before the first of them is answered. Three keep a line of 460,800 baud busy over an
/// adapter that delivers every 16 ms, and while a page of flash is written.
inline constexpr std::size_t kLoaderWindow = 3;

/// Host to loader: request for identity. Answered by Hello, with the version of the image that the loader would start
/// (0.0.0: none), and LoaderInfo.
struct LoaderQuery {
  static constexpr MessageType kType = MessageType::kLoaderQuery;
  static constexpr std::size_t kMaxBytes = 0;
};

/// Loader to host.
struct LoaderInfo {
  static constexpr MessageType kType = MessageType::kLoaderInfo;
  static constexpr std::size_t kMaxBytes = 36;

  std::uint16_t loader_version = 0;
  std::uint16_t block_bytes = 0;     // data of each LoaderData but the last
  std::uint32_t slot_offset = 0;     // position of the image in the flash
  std::uint32_t capacity_bytes = 0;  // longest image
  Text<24> board;
};

/// Host to loader: an image follows. The slot is erased before the Ack, which takes seconds. Ack value: the offset
/// expected first; not 0 when the loader already has the beginning of the same image.
struct LoaderBegin {
  static constexpr MessageType kType = MessageType::kLoaderBegin;
  static constexpr std::size_t kMaxBytes = 32;

  std::uint32_t image_bytes = 0;
  std::uint32_t image_crc32 = 0;
  Text<24> board;  // the board the image is for
};

/// Host to loader: bytes of the image at `offset`. Ack value: the offset expected next. A block that was already taken
/// (lost ack) is acknowledged again; one too early gets Nak kOutOfOrder with the offset expected.
struct LoaderData {
  static constexpr MessageType kType = MessageType::kLoaderData;
  static constexpr std::size_t kMaxData = 256;
  static constexpr std::size_t kMaxBytes = 6 + kMaxData;

  std::uint32_t offset = 0;
  StaticVector<std::uint8_t, kMaxData> data;
};

/// Host to loader: compare the CRC-32 of the written bytes with the announced one and, when they are equal, mark the
/// slot as the newest. Ack value: the CRC found.
struct LoaderVerify {
  static constexpr MessageType kType = MessageType::kLoaderVerify;
  static constexpr std::size_t kMaxBytes = 0;
};

/// Host to loader: restart, with the newest good image. The Ack (value: 0) comes before.
struct LoaderStart {
  static constexpr MessageType kType = MessageType::kLoaderStart;
  static constexpr std::size_t kMaxBytes = 0;
};

inline void write(const LoaderQuery&, ByteWriter&) {}
inline void read(ByteReader&, LoaderQuery&) {}
void write(const LoaderInfo& message, ByteWriter& out);
void read(ByteReader& in, LoaderInfo& message);
void write(const LoaderBegin& message, ByteWriter& out);
void read(ByteReader& in, LoaderBegin& message);
void write(const LoaderData& message, ByteWriter& out);
void read(ByteReader& in, LoaderData& message);
inline void write(const LoaderVerify&, ByteWriter&) {}
inline void read(ByteReader&, LoaderVerify&) {}
inline void write(const LoaderStart&, ByteWriter&) {}
inline void read(ByteReader&, LoaderStart&) {}

}  // namespace pharos::wire
