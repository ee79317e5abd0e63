// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "host/table/byte_source.hpp"

namespace pharos::host {

/// Bytes of an input that are looked at before they are used: for formats whose pieces are recognised by what follows
/// them, and searched after damage. Memory: what is looked ahead, and at most twice kReadBytes.
class Lookahead {
 public:
  explicit Lookahead(ByteSource source) : source_(std::move(source)) {}

  /// Reads until so many unused bytes are there; false where the input ends before.
  bool have(std::size_t count);
  /// The first of them; have(count) was true.
  std::span<const std::uint8_t> ahead(std::size_t count) const { return std::span(buffer_).subspan(used_, count); }
  /// The first of them are used. have() makes earlier results of ahead() invalid, this does not.
  void use(std::size_t count) { used_ += count; }

  /// The gzip data ended before their end.
  bool cut_off() const { return source_.cut_off(); }
  const std::string& name() const { return source_.name(); }

 private:
  static constexpr std::size_t kReadBytes = 128 * 1024;

  ByteSource source_;
  std::vector<std::uint8_t> buffer_;
  std::size_t used_ = 0;  // of the buffer
  bool ended_ = false;
};

}  // namespace pharos::host
