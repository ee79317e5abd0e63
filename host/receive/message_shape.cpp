// SPDX-License-Identifier: Apache-2.0
#include "host/receive/message_shape.hpp"

#include <cstdint>

namespace pharos::host {
namespace {

constexpr std::size_t kFingerprint_bytes = 8;

/// Walks bytes along a shape; `ok` is false once they have disagreed.
struct Walk {
  const unsigned char* data = nullptr;
  std::size_t left = 0;
  bool ok = true;

  void skip(std::size_t bytes) {
    ok = ok && bytes <= left;
    if (!ok) return;
    data += bytes;
    left -= bytes;
  }
  std::int32_t length() {
    const unsigned char* at = data;
    skip(4);
    if (!ok) return 0;
    return static_cast<std::int32_t>(std::uint32_t{at[0]} << 24U | std::uint32_t{at[1]} << 16U |
                                     std::uint32_t{at[2]} << 8U | at[3]);
  }
  void text() {  // its length counts the zero at its end
    const std::int32_t size = length();
    ok = ok && size >= 1;
    if (ok) skip(static_cast<std::size_t>(size));
  }
};

// Bytes of an entry that has numbers alone; 0 for any other.
std::size_t fixed_size(std::string_view entry) {
  std::size_t sum = 0, number = 0;
  for (const char c : entry) {
    const bool digit = c >= '0' && c <= '9';
    if (!digit && c != ' ') return 0;
    if (digit) number = 10 * number + static_cast<std::size_t>(c - '0');
    if (digit) continue;
    sum += number;
    number = 0;
  }
  return sum + number;
}

std::size_t end_of_list(std::string_view shape) {
  std::size_t depth = 1, at = 0;
  while (depth > 0) {
    if (shape[at] == '(') ++depth;
    if (shape[at] == ')') --depth;
    ++at;
  }
  return at;
}

void follow(Walk& walk, std::string_view shape) {
  std::size_t number = 0;
  for (std::size_t at = 0; at < shape.size() && walk.ok; ++at) {
    const char c = shape[at];
    if (c >= '0' && c <= '9') number = 10 * number + static_cast<std::size_t>(c - '0');
    const bool ends = c == ' ' || at + 1 == shape.size();
    if (ends && number > 0) {
      walk.skip(number);
      number = 0;
    }
    if (c == 's') walk.text();
    if (c == '(') {
      const std::size_t size = end_of_list(shape.substr(at + 1));
      const std::string_view entry = shape.substr(at + 1, size - 1);
      const std::int32_t count = walk.length();
      walk.ok = walk.ok && count >= 0;
      if (const std::size_t bytes = fixed_size(entry); bytes > 0 && walk.ok) {
        walk.skip(bytes * static_cast<std::size_t>(count));
      } else {
        for (std::int32_t i = 0; i < count && walk.ok; ++i) follow(walk, entry);
      }
      at += size;
    }
  }
}

}  // namespace

bool has_fingerprint(const void* data, int size, std::int64_t fingerprint) {
  if (size < static_cast<int>(kFingerprint_bytes)) return false;
  const auto* bytes = static_cast<const unsigned char*>(data);
  std::uint64_t read = 0;
  for (std::size_t k = 0; k < kFingerprint_bytes; ++k) read = read << 8U | bytes[k];
  return read == static_cast<std::uint64_t>(fingerprint);
}

bool has_shape(const void* data, int size, std::string_view shape) {
  Walk walk{static_cast<const unsigned char*>(data), static_cast<std::size_t>(size < 0 ? 0 : size)};
  walk.skip(kFingerprint_bytes);
  follow(walk, shape);
  return walk.ok && walk.left == 0;
}

}  // namespace pharos::host
