// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "host/images/picture.hpp"
#include "host/support/input_error.hpp"

namespace pharos::host {

using Bytes = std::vector<std::uint8_t>;

inline Bytes bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

/// One small file of each kind: the fuzz target's corpus.
inline Bytes corpus(const std::string& name) {
  std::ifstream in(std::filesystem::path(PHAROS_CORPUS) / name, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline std::string error_message_of(const Bytes& bytes) {
  try {
    decode_picture(bytes, "some image");
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::StartsWith("some image: "));
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return error.what();
  }
  return "none";
}

/// Appends little-endian numbers.
inline void put(Bytes& bytes, std::uint32_t value, int count) {
  for (int k = 0; k < count; ++k) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * k)));
}

}  // namespace pharos::host
