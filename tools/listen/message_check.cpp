// SPDX-License-Identifier: Apache-2.0
#include "tools/listen/message_check.hpp"

#include <algorithm>
#include <charconv>
#include <optional>

namespace pharos::tools {
namespace {

constexpr std::size_t kLengthBytes = 4;
constexpr std::string_view kPose = "24 s s 1 s s s s 1 s 457";
constexpr std::string_view kPointing = "16 s s s s 1 s 5 192";
constexpr std::string_view kSpin = "16 s s s s s 1 156";
constexpr std::string_view kStatus = "16 s s 8 s s [ s 8 ] [ s s s s s s 40 [ s 8 ] ]";
constexpr std::string_view kBearings = "16 s s 1 s s 1 [ 35 ]";

// Reads a message along its layout.
class Walk {
 public:
  explicit Walk(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  /// False where a length does not fit.
  bool follow(std::string_view layout) {
    while (!layout.empty()) {
      const std::string_view token = next_token(layout);
      if (token == "s") {
        if (!text()) return false;
      } else if (token == "[") {
        const std::string_view inner = inner_of(layout);
        if (!list(inner)) return false;
      } else if (!token.empty() && !fixed(token)) {
        return false;
      }
    }
    return true;
  }
  bool at_end() const { return bytes_.empty(); }

 private:
  static std::string_view next_token(std::string_view& layout) {
    const std::string_view token = layout.substr(0, layout.find(' '));
    layout.remove_prefix(std::min(layout.size(), token.size() + 1));
    return token;
  }
  // What is between the bracket that was read and its partner.
  static std::string_view inner_of(std::string_view& layout) {
    const std::string_view all = layout;
    for (int depth = 1; depth > 0;) {
      const std::string_view token = next_token(layout);
      depth += token == "[" ? 1 : token == "]" ? -1 : 0;
    }
    const std::size_t closing = all.size() - layout.size();
    return all.substr(0, all.rfind(']', closing - 1));
  }
  bool skip(std::size_t count) {
    if (count > bytes_.size()) return false;
    bytes_ = bytes_.subspan(count);
    return true;
  }
  bool fixed(std::string_view token) {
    std::size_t count = 0;
    std::from_chars(token.data(), token.data() + token.size(), count);
    return skip(count);
  }
  // Big-endian; empty where negative or beyond the message.
  std::optional<std::size_t> length() {
    if (bytes_.size() < kLengthBytes) return std::nullopt;
    std::uint32_t value = 0;
    for (std::size_t k = 0; k < kLengthBytes; ++k) value = value << 8U | bytes_[k];
    bytes_ = bytes_.subspan(kLengthBytes);
    if (value > bytes_.size()) return std::nullopt;  // every field of a list has a byte at least
    return value;
  }
  // With its closing zero.
  bool text() {
    const auto count = length();
    return count && *count > 0 && skip(*count);
  }
  bool list(std::string_view inner) {
    const auto count = length();
    if (!count) return false;
    for (std::size_t k = 0; k < *count; ++k) {
      if (!follow(inner)) return false;
    }
    return true;
  }

  std::span<const std::uint8_t> bytes_;
};

}  // namespace

std::string_view layout_of(const pose_t&) { return kPose; }
std::string_view layout_of(const pointing_t&) { return kPointing; }
std::string_view layout_of(const spin_t&) { return kSpin; }
std::string_view layout_of(const status_t&) { return kStatus; }
std::string_view layout_of(const bearings_t&) { return kBearings; }

bool fits_layout(std::string_view layout, std::span<const std::uint8_t> fields) {
  Walk walk(fields);
  return walk.follow(layout) && walk.at_end();
}

}  // namespace pharos::tools
