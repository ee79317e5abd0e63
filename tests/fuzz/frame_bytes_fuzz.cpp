// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include "host/device/pixel_format.hpp"

// Any bytes of a camera are a frame of exactly the expected size, or nothing is written.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pharos::host;
  if (size < 2) return 0;
  const std::span<const std::uint8_t> bytes(data + 2, size - 2);
  const std::size_t pixels = data[0];
  const bool raw = (data[1] & 1) != 0;
  const bool grey_8 = !raw && (data[1] & 2) != 0;
  constexpr std::uint16_t kMark = 0xA5A5;
  std::vector<std::uint16_t> depth(pixels, kMark);
  std::vector<std::uint16_t> intensity(pixels, kMark);
  if (grey_8) {
    const bool taken = unpack_8(bytes, depth);
    if (taken != (bytes.size() == pixels)) std::abort();
    for (std::size_t i = 0; i < pixels; ++i) {
      if (depth[i] != (taken ? 257 * bytes[i] : kMark)) std::abort();
    }
    return 0;
  }
  const bool taken = raw ? unpack_abcy16(bytes, depth, intensity) : unpack_16(bytes, depth);
  if (taken != (bytes.size() == pixels * (raw ? 8 : 2))) std::abort();
  for (std::size_t i = 0; i < pixels; ++i) {
    const std::size_t at = raw ? 8 * i + 4 : 2 * i;
    const int expected = taken ? bytes[at] | bytes[at + 1] << 8 : kMark;
    if (depth[i] != expected) std::abort();
  }
  return 0;
}
