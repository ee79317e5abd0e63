// SPDX-License-Identifier: Apache-2.0
#include "host/config/lcm_url.hpp"

#include <arpa/inet.h>

#include <charconv>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

namespace pharos::host {
namespace {

struct Option {
  std::string_view key;
  std::string_view value;
};

/// Removes and returns the part of `text` before `mark`; all of it if there is no mark.
std::string_view cut(std::string_view& text, char mark) {
  const std::size_t at = text.find(mark);
  const std::string_view head = text.substr(0, at);
  text.remove_prefix(at == std::string_view::npos ? text.size() : at + 1);
  return head;
}

std::vector<Option> options_of(std::string_view text) {
  std::vector<Option> options;
  while (!text.empty()) {
    std::string_view value = cut(text, '&');
    const std::string_view key = cut(value, '=');
    options.push_back({key, value});
  }
  return options;
}

bool is_number_in(std::string_view text, std::int64_t low, std::int64_t high) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size() && value >= low && value <= high;
}

bool is_multicast(const std::string& address) {
  in_addr parsed{};
  return ::inet_pton(AF_INET, address.c_str(), &parsed) == 1 && IN_MULTICAST(ntohl(parsed.s_addr));
}

std::string udpm_error(std::string_view network, const std::vector<Option>& options) {
  const bool has_port = network.find(':') != std::string_view::npos;
  const std::string address(cut(network, ':'));
  if (!address.empty() && !is_multicast(address)) {
    return "\"" + address + "\" is no multicast address: 224.0.0.0 to 239.255.255.255, such as 239.255.76.67";
  }
  if (has_port && !is_number_in(network, 1, 65'535)) {
    return "\"" + std::string(network) + "\" is no port: 1 to 65535, such as 7667";
  }
  for (const Option& option : options) {
    const std::string text = "\"" + std::string(option.key) + "=" + std::string(option.value) + "\"";
    if (option.key == "ttl") {
      if (!is_number_in(option.value, 0, 255)) return text + ": must be 0 (this computer only) to 255";
    } else if (option.key == "recv_buf_size") {
      if (!is_number_in(option.value, 1, std::numeric_limits<std::int32_t>::max())) return text + ": must be in bytes";
    } else {
      return text + " is no option of udpm: those are ttl and recv_buf_size";
    }
  }
  return "";
}

std::string file_url_error(std::string_view path, const std::vector<Option>& options) {
  if (path.empty()) return "names no file: file:///path/to/log?mode=w";
  for (const Option& option : options) {
    if (option.key == "mode" && (option.value == "w" || option.value == "a")) return "";
  }
  return "would be read, not written: add ?mode=w (a new file) or ?mode=a (go on)";
}

}  // namespace

std::string lcm_url_error(const std::string& url) {
  constexpr std::string_view kUdpm = "udpm://";
  constexpr std::string_view kFile = "file://";
  constexpr std::string_view kTcpq = "tcpq://";
  constexpr std::string_view kMemq = "memq://";
  std::string_view rest = url;
  if (rest.find('\0') != std::string_view::npos) return "holds a zero character";
  if (rest.starts_with(kTcpq)) return "tcpq:// waits for its server and would hold up every pose; use udpm://";
  if (rest.starts_with(kMemq)) return "memq:// stays within this process, where nobody listens; use udpm://";
  const bool is_udpm = rest.starts_with(kUdpm);
  if (!is_udpm && !rest.starts_with(kFile)) return "must begin with udpm:// or file://";
  rest.remove_prefix(is_udpm ? kUdpm.size() : kFile.size());
  const std::string_view network = cut(rest, '?');
  const std::vector<Option> options = options_of(rest);
  return is_udpm ? udpm_error(network, options) : file_url_error(network, options);
}

}  // namespace pharos::host
