// SPDX-License-Identifier: Apache-2.0
#include "host/images/pnm_format.hpp"

#include <cctype>
#include <optional>

#include "host/support/input_error.hpp"

namespace pharos::host {
namespace {

using Bytes = std::span<const std::uint8_t>;

// Header of a binary PGM or PPM: numbers between white space and comments (# to the end of the line).
class PnmHeader {
 public:
  explicit PnmHeader(Bytes bytes) : bytes_(bytes) {}

  std::optional<std::uint32_t> number() {
    skip_space();
    std::uint32_t value = 0;
    const std::size_t begin = at_;
    for (; at_ < bytes_.size() && std::isdigit(bytes_[at_]) != 0; ++at_) {
      value = value * 10 + (bytes_[at_] - '0');
      if (value > 1'000'000'000) return std::nullopt;
    }
    if (at_ == begin) return std::nullopt;
    return value;
  }
  // The data after the single white space that ends the header.
  Bytes rest() const { return at_ < bytes_.size() ? bytes_.subspan(at_ + 1) : Bytes(); }

 private:
  void skip_space() {
    while (at_ < bytes_.size() && (std::isspace(bytes_[at_]) != 0 || bytes_[at_] == '#')) {
      if (bytes_[at_] == '#') {
        while (at_ < bytes_.size() && bytes_[at_] != '\n') ++at_;
      } else {
        ++at_;
      }
    }
  }

  Bytes bytes_;
  std::size_t at_ = 2;  // after "P5" or "P6"
};

}  // namespace

bool is_pnm(Bytes bytes) { return bytes.size() >= 3 && bytes[0] == 'P' && (bytes[1] == '5' || bytes[1] == '6'); }

Picture decode_pnm(Bytes bytes, const std::string& name) {
  const bool grey = bytes[1] == '5';
  const std::string kind = grey ? "PGM" : "PPM";
  PnmHeader header(bytes);
  const auto width = header.number(), height = header.number(), maximum = header.number();
  if (!width || !height || !maximum || *width == 0 || *height == 0 || *maximum == 0 || *maximum > 65535) {
    throw InputError(name + ": no " + kind + " header (" + (grey ? "P5" : "P6") +
                     ", width, height, greatest value up to 65535)");
  }
  require_readable_size(*width, *height, name);
  Picture picture{
      static_cast<std::int32_t>(*width), static_cast<std::int32_t>(*height), grey ? 1 : 3, *maximum > 255 ? 16 : 8, {}};
  const std::size_t values = picture.pixels() * static_cast<std::size_t>(picture.channels);
  const std::size_t value_bytes = picture.bits == 16 ? 2 : 1;
  const Bytes data = header.rest();
  if (data.size() != values * value_bytes) {
    refuse_damaged(name, kind.c_str(), data.size() < values * value_bytes ? kLessData : kMoreData);
  }
  picture.values.resize(values);
  for (std::size_t k = 0; k < values; ++k) {
    picture.values[k] =
        static_cast<std::uint16_t>(value_bytes == 2 ? data[2 * k] << 8 | data[2 * k + 1] : data[k] * 257);
  }
  return picture;
}

}  // namespace pharos::host
