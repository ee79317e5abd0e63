// SPDX-License-Identifier: Apache-2.0
#pragma once

// Messages and logs of LCM as bytes, written here from the format's description.
#include <cstddef>
#include <cstdint>
#include <string>

namespace pharos::test {

inline std::string big_endian(std::uint64_t value, int bytes) {
  std::string out;
  for (int k = bytes - 1; k >= 0; --k) out += static_cast<char>(value >> 8 * k & 0xFFU);
  return out;
}

/// One event of a log.
inline std::string logged(std::int64_t utime_us, const std::string& channel, const std::string& data) {
  return big_endian(0xEDA1DA01U, 4) + big_endian(7, 8) + big_endian(static_cast<std::uint64_t>(utime_us), 8) +
         big_endian(channel.size(), 4) + big_endian(data.size(), 4) + channel + data;
}

template <class Message>
std::string encoded(const Message& message) {
  std::string out(static_cast<std::size_t>(message.getEncodedSize()), '\0');
  message.encode(out.data(), 0, static_cast<int>(out.size()));
  return out;
}

}  // namespace pharos::test
