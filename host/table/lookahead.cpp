// SPDX-License-Identifier: Apache-2.0
#include "host/table/lookahead.hpp"

namespace pharos::host {

bool Lookahead::have(std::size_t count) {
  while (buffer_.size() - used_ < count && !ended_) {
    if (used_ >= kReadBytes) {
      buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(used_));
      used_ = 0;
    }
    const std::size_t before = buffer_.size();
    buffer_.resize(before + kReadBytes);
    const std::size_t got = source_.read({reinterpret_cast<char*>(buffer_.data()) + before, kReadBytes});
    buffer_.resize(before + got);
    ended_ = got == 0;
  }
  return buffer_.size() - used_ >= count;
}

}  // namespace pharos::host
