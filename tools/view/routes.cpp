// SPDX-License-Identifier: Apache-2.0
#include "tools/view/routes.hpp"

#include <algorithm>
#include <charconv>
#include <cstring>

#include "tools/view/page_files.hpp"

namespace pharos::tools {
namespace {

constexpr double kLongestLog_s = 1e9;

// A host without its port; empty where the port is not `port`.
std::string_view without_port(std::string_view host, std::uint16_t port) {
  const std::string suffix = ':' + std::to_string(port);
  if (host.ends_with(suffix)) return host.substr(0, host.size() - suffix.size());
  return port == 80 ? host : std::string_view();
}

bool is_address(std::string_view host) {
  if (host.starts_with('[') && host.ends_with(']')) {
    host = host.substr(1, host.size() - 2);
    return !host.empty() && host.find_first_not_of("0123456789abcdefABCDEF:.") == std::string_view::npos;
  }
  return !host.empty() && host.find_first_not_of("0123456789.") == std::string_view::npos;
}

bool is_our_host(std::string_view host, const Access& access) {
  const std::string_view name = without_port(host, access.port);
  if (name == "localhost" || name == "127.0.0.1" || name == "[::1]") return true;
  return !access.loopback && is_address(name);
}

bool is_our_origin(std::string_view origin, std::string_view host) {
  constexpr std::string_view kScheme = "http://";
  return origin.empty() || (origin.starts_with(kScheme) && origin.substr(kScheme.size()) == host);
}

Route refused(int status, const char* reason) { return {Answer::kRefused, status, reason, false}; }

// /preview/0 to /preview/99.
std::optional<std::size_t> preview_number(std::string_view path) {
  constexpr std::string_view kFolder = "/preview/";
  if (!path.starts_with(kFolder)) return std::nullopt;
  const std::string_view number = path.substr(kFolder.size());
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
  const bool whole = error == std::errc{} && end == number.data() + number.size() && number.size() <= 2;
  return whole ? std::optional(value) : std::nullopt;
}

Route route_of_path(const Request& request, const Access& access) {
  const bool reads = request.method == "GET" || request.method == "HEAD";
  if (request.path == "/control" && access.has_controls) {
    return request.method == "POST" ? Route{Answer::kControl, 204, "", false} : refused(405, "POST it");
  }
  if (!reads) return refused(405, "only GET");
  if (request.path == "/states")
    return request.method == "GET" ? Route{Answer::kStates, 200, "", false} : refused(405, "only GET");
  if (request.path == "/targets") return {Answer::kTargets, 200, "", false};
  if (const auto preview = preview_number(request.path)) return {Answer::kPreview, 200, "", false, *preview};
  if (find_page_file(request.path) != nullptr) return {Answer::kFile, 200, "", false};
  return refused(404, "no such page");
}

template <class Number>
bool read_number(const char* text, double low, double high, std::optional<Number>& value) {
  if (text == nullptr) return true;
  double number = 0.0;
  const char* end = text + std::strlen(text);
  const auto [stop, error] = std::from_chars(text, end, number);
  if (error != std::errc{} || stop != end || !(number >= low && number <= high)) return false;
  value = static_cast<Number>(number);
  return true;
}

}  // namespace

bool equal_in_constant_time(std::string_view a, std::string_view b) {
  unsigned difference = a.size() == b.size() ? 0U : 1U;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const char other = i < b.size() ? b[i] : '\0';
    difference |= static_cast<unsigned char>(a[i] ^ other);
  }
  return difference == 0U;
}

Route route_of(const Request& request, const Access& access) {
  if (!is_our_host(request.host, access)) return refused(421, "open the page by its address, not by a name");
  if (!is_our_origin(request.origin, request.host)) return refused(403, "asked by a page of another origin");
  // A link to the page is followed; another site's page may neither read nor hold a connection.
  if (request.fetch_site == "cross-site" && request.path != "/") return refused(403, "asked by another site's page");
  bool give_cookie = false;
  if (!access.token.empty() && !equal_in_constant_time(request.cookie_token, access.token)) {
    if (!equal_in_constant_time(request.query_token, access.token)) {
      return refused(401, "a token is needed: open the address that pharos view printed");
    }
    give_cookie = true;
  }
  Route route = route_of_path(request, access);
  route.give_cookie = give_cookie && route.answer != Answer::kRefused;
  return route;
}

std::optional<ControlRequest> control_of(const char* seek, const char* speed, const char* playing) {
  ControlRequest control;
  std::optional<int> plays;
  if (!read_number(seek, 0.0, kLongestLog_s, control.seek_s) ||
      !read_number(speed, kMinSpeed, kMaxSpeed, control.speed) || !read_number(playing, 0.0, 1.0, plays)) {
    return std::nullopt;
  }
  if (plays) control.playing = *plays != 0;
  return control;
}

}  // namespace pharos::tools
