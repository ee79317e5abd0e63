// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace pharos::host {

/// Bytes of a file, of a gzip file (recognised by content, not by name) or, for the path `-`, of standard input.
///
/// Returns the available bytes without waiting for a full buffer, so that a live pipe is processed without delay.
class ByteSource {
 public:
  /// Throws InputError when the file cannot be opened.
  explicit ByteSource(const std::string& path);
  ~ByteSource();
  ByteSource(ByteSource&&) noexcept;
  ByteSource& operator=(ByteSource&&) noexcept;

  /// Next bytes, at least one; 0 at the end. Throws InputError on a read error or broken gzip data.
  std::size_t read(std::span<char> out);
  /// Leaves the next bytes out; a plain file's without reading them. Returns how many there were, at most `count` (a
  /// plain file's end is noticed by the next read).
  std::int64_t skip(std::int64_t count);
  /// The first bytes still to be read, at least `count` of them unless the input ends before. Not consumed.
  std::string_view peek(std::size_t count);
  /// `before_waiting` is called whenever no bytes are available, before read() waits for them: the time to flush the
  /// results so far.
  void on_pause(std::function<void()> before_waiting);
  /// The gzip data ended before its end mark: the bytes before were returned (a recording cut off while writing).
  bool cut_off() const;
  /// For messages: the path, or "standard input".
  const std::string& name() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace pharos::host
