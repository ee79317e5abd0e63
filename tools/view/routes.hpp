// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace pharos::tools {

/// Who may read the page.
struct Access {
  std::uint16_t port = 0;
  bool loopback = true;       // listens on this computer alone
  std::string token;          // required where not empty
  bool has_controls = false;  // a log is replayed
};

/// What of a request decides its answer. Headers that it does not have are empty.
struct Request {
  std::string_view method;
  std::string_view path;
  std::string_view host;
  std::string_view origin;
  std::string_view fetch_site;    // Sec-Fetch-Site
  std::string_view cookie_token;  // the cookie that the page was given
  std::string_view query_token;   // ?token=
};

enum class Answer : std::uint8_t { kRefused, kFile, kStates, kTargets, kControl, kPreview };

struct Route {
  Answer answer = Answer::kRefused;
  int status = 200;  // of HTTP
  const char* reason = "";
  bool give_cookie = false;  // a good token came in the address: the page's own requests send it as a cookie
  std::size_t preview = 0;   // which one
};

/// The answer to a request. Refused are: other methods; a Host that is a name (a foreign page whose name was made to
/// point here, DNS rebinding) other than localhost; another Origin; requests that another site's page makes; a missing
/// or wrong token; and every path but the page's own, compared whole.
Route route_of(const Request& request, const Access& access);

/// Whether two texts are equal, in a time that does not depend on where they differ.
bool equal_in_constant_time(std::string_view a, std::string_view b);

/// What a page asks a replay to do. Empty fields stay as they are.
struct ControlRequest {
  std::optional<double> seek_s;
  std::optional<double> speed;  // 0.1 to 20
  std::optional<bool> playing;
};
inline constexpr double kMinSpeed = 0.1;
inline constexpr double kMaxSpeed = 20.0;

/// From the query's values; null for a missing one. Empty where one is no number or out of range.
std::optional<ControlRequest> control_of(const char* seek, const char* speed, const char* playing);

}  // namespace pharos::tools
