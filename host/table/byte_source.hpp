// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace pharos::host {

/// Bytes of a file, of a gzip file (told by content, not by name) or, for the path `-`, of standard input.
///
/// Gives out what is there without waiting for a full buffer, so that a live pipe is followed as it comes.
class ByteSource {
 public:
  /// Throws InputError when the file cannot be opened.
  explicit ByteSource(const std::string& path);
  ~ByteSource();
  ByteSource(ByteSource&&) noexcept;
  ByteSource& operator=(ByteSource&&) noexcept;

  /// Next bytes, at least one; 0 at the end. Throws InputError on a read error or broken gzip data.
  std::size_t read(std::span<char> out);
  /// The first bytes still to be read, at least `count` of them unless the input ends before. Not consumed.
  std::string_view peek(std::size_t count);
  /// `before_waiting` is called whenever nothing is there to be read yet, before read() waits for it: the moment to
  /// show what came of the bytes so far.
  void on_pause(std::function<void()> before_waiting);
  /// The gzip data ended before its end mark: what came before was given out (a recording cut off while writing).
  bool cut_off() const;
  /// For messages: the path, or "standard input".
  const std::string& name() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace pharos::host
