// SPDX-License-Identifier: Apache-2.0
#include "pharos/signature/ed25519.hpp"

#include <bit>
#include <cstddef>
#include <cstring>

#include "pharos/signature/field.hpp"
#include "pharos/signature/sha2.hpp"

namespace pharos::signature {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are read as they lie in memory");

/// Order of the base point (RFC 8032, 5.1), and d, the square root of -1 and the base point.
constexpr Words kOrder = {0x5cf5d3ed, 0x5812631a, 0xa2f79cd6, 0x14def9de, 0, 0, 0, 0x10000000};
constexpr Words kD = {0x135978a3, 0x75eb4dca, 0x4141d8ab, 0x00700a4d, 0x7779e898, 0x8cc74079, 0x2b6ffe73, 0x52036cee};
constexpr Words kRootOfMinusOne = {0x4a0ea0b0, 0xc4ee1b27, 0xad2fe478, 0x2f431806,
                                   0x3dfbd7a7, 0x2b4d0099, 0x4fc1df0b, 0x2b832480};
constexpr Words kBaseX = {0x8f25d51a, 0xc9562d60, 0x9525a7b2, 0x692cc760,
                          0xfdd6dc5c, 0xc0a4e231, 0xcd6e53fe, 0x216936d3};
constexpr Words kBaseY = {0x66666658, 0x66666666, 0x66666666, 0x66666666,
                          0x66666666, 0x66666666, 0x66666666, 0x66666666};
constexpr Words kOne = {1};
constexpr std::uint32_t kSign = 0x80000000;  // in the last word of an encoded point

/// x = X/Z, y = Y/Z, x y = T/Z (RFC 8032, 5.1.4).
struct Point {
  Words x, y, z, t;
};

Point point_of(const Words& x, const Words& y) { return {x, y, kOne, times(x, y)}; }

/// Complete: also for equal points and the neutral one.
Point sum(const Point& p, const Point& q) {
  const Words a = times(minus(p.y, p.x), minus(q.y, q.x));
  const Words b = times(plus(p.y, p.x), plus(q.y, q.x));
  Words c = times(times(p.t, kD), q.t);
  c = plus(c, c);
  Words d = times(p.z, q.z);
  d = plus(d, d);
  const Words e = minus(b, a);
  const Words f = minus(d, c);
  const Words g = plus(d, c);
  const Words h = plus(b, a);
  return {times(e, f), times(g, h), times(f, g), times(e, h)};
}

/// The negative of an encoded point (RFC 8032, 5.1.3); false where the encoding is none.
bool decode_negative(Words y, Point& point) {
  const std::uint32_t sign = y[7] & kSign;
  y[7] &= ~kSign;
  if (reduced(y) != y) return false;
  const Words yy = times(y, y);
  const Words u = minus(yy, kOne);
  const Words v = plus(times(yy, kD), kOne);
  const Words v3 = times(times(v, v), v);
  const Words uv3 = times(u, v3);
  // x = u v^3 (u v^7)^((p - 5) / 8): a root of u / v or of -u / v.
  Words x = times(uv3, power(times(times(uv3, v3), v), 251, 0b11101));
  const Words square = times(times(x, x), v);
  if (reduced(minus(square, u)) != Words{}) {
    if (reduced(plus(square, u)) != Words{}) return false;
    x = times(x, kRootOfMinusOne);
  }
  x = reduced(x);
  if (x == Words{} && sign != 0) return false;
  if (x[0] << 31 == sign) x = minus(Words{}, x);
  point = point_of(x, y);
  return true;
}

Words encoded(const Point& point) {
  const Words inverse = power(point.z, 254, 0b01011);  // to the power of p - 2
  const Words x = reduced(times(point.x, inverse));
  Words y = reduced(times(point.y, inverse));
  y[7] |= x[0] << 31;
  return y;
}

/// SHA-512 of R, key and message modulo the order.
Words challenge(const std::uint8_t* r, const PublicKey& key, std::span<const std::uint8_t> message) {
  Sha512 hash;
  hash.add({r, 32});
  hash.add(key);
  hash.add(message);
  const Sha512::Digest digest = hash.finish();
  Words rest{};
  for (int bit = 511; bit >= 0; --bit) {
    std::uint32_t carry = (static_cast<std::uint32_t>(digest[static_cast<std::size_t>(bit) / 8]) >> (bit % 8)) & 1u;
    for (std::uint32_t& word : rest) {
      const std::uint32_t next = word >> 31;
      word = (word << 1) | carry;
      carry = next;
    }
    Words less = rest;
    if (!subtract_words(less, kOrder)) rest = less;
  }
  return rest;
}

std::uint32_t bit_of(const Words& number, std::size_t bit) { return (number[bit / 32] >> (bit % 32)) & 1; }

}  // namespace

bool verify(const Signature& signature, const PublicKey& key, std::span<const std::uint8_t> message) {
  std::array<Words, 2> parts;  // R, S
  std::memcpy(parts.data(), signature.data(), sizeof parts);
  Words rest = parts[1];
  if (!subtract_words(rest, kOrder)) return false;
  Words encoded_key;
  std::memcpy(encoded_key.data(), key.data(), sizeof encoded_key);
  std::array<Point, 3> points;  // B, -A, B - A
  if (!decode_negative(encoded_key, points[1])) return false;
  points[0] = point_of(kBaseX, kBaseY);
  points[2] = sum(points[0], points[1]);
  const Words k = challenge(signature.data(), key, message);
  Point result{{}, kOne, kOne, {}};
  for (std::size_t bit = 253; bit-- > 0;) {  // both numbers are below 2^253
    result = sum(result, result);
    const std::uint32_t digits = bit_of(parts[1], bit) | (bit_of(k, bit) << 1);
    if (digits != 0) result = sum(result, points[digits - 1]);
  }
  return encoded(result) == parts[0];
}

}  // namespace pharos::signature
