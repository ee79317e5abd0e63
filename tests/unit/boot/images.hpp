// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <random>
#include <span>
#include <string_view>
#include <vector>

#include "pharos/boot_image/boot_image_header.hpp"
#include "pharos/signature/sha2.hpp"
#include "pharos/wire/text.hpp"
#include "unit/boot/model_board.hpp"

namespace pharos::boot::test {

using Bytes = std::vector<std::uint8_t>;

struct ImageOptions {
  std::size_t body_bytes = 1200;
  boot_image::Version version{1, 0, 0};
  std::string_view board = "model";
  std::uint32_t load_address = Machine::kMemoryAddress;
  bool is_signed = true;
};

inline Bytes body_of(const Bytes& file) {
  const auto body = std::span(file).subspan(boot_image::kPageBytes);
  return {body.begin(), body.end()};
}

/// A complete image file with random bytes as its body.
inline Bytes make_image(unsigned seed, const ImageOptions& options = {}) {
  std::mt19937 random(seed);
  Bytes body(options.body_bytes);
  for (std::uint8_t& byte : body) byte = static_cast<std::uint8_t>(random());
  boot_image::BootImageHeader header{};
  header.load_address = options.load_address;
  header.entry_address = options.load_address + 4;
  header.version = options.version;
  header.board = wire::Text<24>(options.board).characters;
  header.name = wire::Text<12>("test").characters;
  header = boot_image::sealed(header, body);
  Bytes file(boot_image::kPageBytes + body.size(), 0xFF);
  boot_image::SealedHeader head{header, {signature::sha256(body), {}}};
  head.seal.signature.fill(0xFF);
  if (options.is_signed) head.seal.signature = model_signature(boot_image::signed_bytes_of(head));
  std::memcpy(file.data(), &head, sizeof head);
  std::ranges::copy(body, file.begin() + boot_image::kPageBytes);
  return file;
}

}  // namespace pharos::boot::test
