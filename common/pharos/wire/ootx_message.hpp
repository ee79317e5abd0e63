// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "pharos/base/static_vector.hpp"
#include "pharos/wire/bytes.hpp"
#include "pharos/wire/message_type.hpp"

namespace pharos::wire {

/// One OOTX payload as the station sent it, CRC checked.
struct Ootx {
  static constexpr MessageType kType = MessageType::kOotx;
  static constexpr std::size_t kMaxData = 64;
  static constexpr std::size_t kMaxBytes = 10 + kMaxData;

  std::int64_t time_ticks = 0;
  std::uint8_t station = 0;  // 0 or 1
  StaticVector<std::uint8_t, kMaxData> data;
};

void write(const Ootx& message, ByteWriter& out);
void read(ByteReader& in, Ootx& message);

}  // namespace pharos::wire
