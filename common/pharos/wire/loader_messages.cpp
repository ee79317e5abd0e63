// SPDX-License-Identifier: Apache-2.0
#include "pharos/wire/loader_messages.hpp"

namespace pharos::wire {

void write(const LoaderInfo& message, ByteWriter& out) {
  out.put(message.loader_version);
  out.put(message.block_bytes);
  out.put(message.slot_offset);
  out.put(message.capacity_bytes);
  write(message.board, out);
}

void read(ByteReader& in, LoaderInfo& message) {
  message.loader_version = in.get<std::uint16_t>();
  message.block_bytes = in.get<std::uint16_t>();
  message.slot_offset = in.get<std::uint32_t>();
  message.capacity_bytes = in.get<std::uint32_t>();
  read(in, message.board);
}

void write(const LoaderBegin& message, ByteWriter& out) {
  out.put(message.image_bytes);
  out.put(message.image_crc32);
  write(message.board, out);
}

void read(ByteReader& in, LoaderBegin& message) {
  message.image_bytes = in.get<std::uint32_t>();
  message.image_crc32 = in.get<std::uint32_t>();
  read(in, message.board);
}

void write(const LoaderData& message, ByteWriter& out) {
  out.put(message.offset);
  out.put(static_cast<std::uint16_t>(message.data.size()));
  out.put_bytes({message.data.data(), message.data.size()});
}

void read(ByteReader& in, LoaderData& message) {
  message.offset = in.get<std::uint32_t>();
  const auto count = in.get<std::uint16_t>();
  in.refuse_if(count > LoaderData::kMaxData);
  if (count > LoaderData::kMaxData) return;
  message.data.resize(count);
  in.get_bytes({message.data.data(), message.data.size()});
}

}  // namespace pharos::wire
