// SPDX-License-Identifier: Apache-2.0
#include "tools/view/routes.hpp"

#include <gtest/gtest.h>

#include <string>

namespace pharos::tools {
namespace {

constexpr Access kHere{7668, true, "", false};
constexpr const char* kToken = "0123456789abcdef";

Access elsewhere() { return {7668, false, kToken, false}; }

Request get(std::string_view path, std::string_view host = "127.0.0.1:7668") {
  Request request;
  request.method = "GET";
  request.path = path;
  request.host = host;
  return request;
}

TEST(Route, LeadsToThePageAndItsStates) {
  EXPECT_EQ(route_of(get("/"), kHere).answer, Answer::kFile);
  EXPECT_EQ(route_of(get("/view.js"), kHere).answer, Answer::kFile);
  EXPECT_EQ(route_of(get("/three.min.js"), kHere).answer, Answer::kFile);
  EXPECT_EQ(route_of(get("/states"), kHere).answer, Answer::kStates);
  EXPECT_EQ(route_of(get("/targets"), kHere).answer, Answer::kTargets);
}

TEST(Route, LeadsToPicturesByTheirNumber) {
  const Route route = route_of(get("/preview/12"), kHere);
  EXPECT_EQ(route.answer, Answer::kPreview);
  EXPECT_EQ(route.preview, 12u);
  for (const char* path : {"/preview", "/preview/", "/preview/x", "/preview/-1", "/preview/1/..", "/preview/100",
                           "/preview/4294967297", "/preview/ 1", "/preview/+1", "/preview/0x1"}) {
    EXPECT_EQ(route_of(get(path), kHere).status, 404) << path;
  }
  Request request = get("/preview/1");
  request.fetch_site = "cross-site";
  EXPECT_EQ(route_of(request, kHere).status, 403);
  request.fetch_site = "";
  request.host = "192.168.1.7:7668";
  EXPECT_EQ(route_of(request, elsewhere()).status, 401) << "with a token alone";
}

TEST(Route, NoOtherPathIsServedHoweverItIsWritten) {
  for (const char* path :
       {"", "/index.html", "//", "/../etc/passwd", "/..%2f..%2fetc/passwd", "/view.js/", "/view.js%00", "/VIEW.JS",
        "/./view.js", "view.js", "/view.css/../../../etc/shadow", "*", "http://127.0.0.1/", "\\..\\"}) {
    const Route route = route_of(get(path), kHere);
    EXPECT_EQ(route.answer, Answer::kRefused) << path;
    EXPECT_EQ(route.status, 404) << path;
  }
}

TEST(Route, AHostThatIsANameIsRefusedBecauseItMayBeAForeignPages) {
  EXPECT_EQ(route_of(get("/", "localhost:7668"), kHere).status, 200);
  EXPECT_EQ(route_of(get("/", "[::1]:7668"), kHere).status, 200);
  for (const char* host :
       {"evil.example:7668", "evil.example", "127.0.0.1", "127.0.0.1:80", "", "127.0.0.1.evil.example:7668",
        "192.168.1.7:7668", "localhost:7668:7668", "[evil]:7668", ":7668"}) {
    EXPECT_EQ(route_of(get("/", host), kHere).status, 421) << host;
  }
}

TEST(Route, ServedElsewhereTheHostIsAnyAddressButNoName) {
  Request request = get("/", "192.168.1.7:7668");
  request.query_token = kToken;
  EXPECT_EQ(route_of(request, elsewhere()).status, 200);
  request.host = "[fe80::1]:7668";
  EXPECT_EQ(route_of(request, elsewhere()).status, 200);
  request.host = "evil.example:7668";
  EXPECT_EQ(route_of(request, elsewhere()).status, 421);
}

TEST(Route, AnotherOriginIsRefused) {
  Request request = get("/states");
  request.origin = "http://127.0.0.1:7668";
  EXPECT_EQ(route_of(request, kHere).status, 200);
  for (const char* origin :
       {"http://evil.example", "null", "https://127.0.0.1:7668", "http://127.0.0.1:7669", "http://"}) {
    request.origin = origin;
    EXPECT_EQ(route_of(request, kHere).status, 403) << origin;
  }
}

TEST(Route, AnotherSitesPageMayOnlyLinkToThePage) {
  Request request = get("/states");
  request.fetch_site = "cross-site";
  EXPECT_EQ(route_of(request, kHere).status, 403);
  request.path = "/";
  EXPECT_EQ(route_of(request, kHere).status, 200);
}

TEST(Route, WithoutTheTokenNothingIsServedElsewhere) {
  for (const char* path : {"/", "/states", "/targets", "/view.js", "/nothing"}) {
    Request request = get(path);
    EXPECT_EQ(route_of(request, elsewhere()).status, 401) << path;
    for (const char* wrong : {"0123456789abcdee", "0123456789abcde", "0123456789abcdef0", "x"}) {
      request.query_token = request.cookie_token = wrong;
      EXPECT_EQ(route_of(request, elsewhere()).status, 401) << wrong;
    }
  }
}

TEST(Route, ATokenInTheAddressIsAnsweredWithACookieThatServesFromThenOn) {
  Request request = get("/");
  request.query_token = kToken;
  EXPECT_TRUE(route_of(request, elsewhere()).give_cookie);
  request.query_token = "";
  request.cookie_token = kToken;
  const Route route = route_of(request, elsewhere());
  EXPECT_EQ(route.status, 200);
  EXPECT_FALSE(route.give_cookie);
}

TEST(Route, OtherMethodsAreRefused) {
  for (const char* method : {"POST", "PUT", "DELETE", "CONNECT", "OPTIONS", "TRACE", "get", "", "\x01"}) {
    Request request = get("/");
    request.method = method;
    EXPECT_EQ(route_of(request, kHere).status, 405) << method;
  }
}

TEST(Route, AReplayIsControlledByPostAlone) {
  Access access = kHere;
  Request request = get("/control");
  request.method = "POST";
  EXPECT_NE(route_of(request, access).answer, Answer::kControl) << "nothing is replayed";
  access.has_controls = true;
  EXPECT_EQ(route_of(request, access).answer, Answer::kControl);
  request.method = "GET";
  EXPECT_EQ(route_of(request, access).status, 405);
}

TEST(Control, TakesNumbersInRangeAndNothingElse) {
  const auto control = control_of("12.5", "4", "0");
  ASSERT_TRUE(control);
  EXPECT_EQ(control->seek_s, 12.5);
  EXPECT_EQ(control->speed, 4.0);
  EXPECT_EQ(control->playing, false);
  const auto empty = control_of(nullptr, nullptr, nullptr);
  ASSERT_TRUE(empty);
  EXPECT_FALSE(empty->seek_s || empty->speed || empty->playing);
  for (const char* wrong : {"nan", "inf", "-1", "1e300", "", "1x", "0x10", " 1"}) {
    EXPECT_FALSE(control_of(wrong, nullptr, nullptr)) << wrong;
    EXPECT_FALSE(control_of(nullptr, wrong, nullptr)) << wrong;
    EXPECT_FALSE(control_of(nullptr, nullptr, wrong)) << wrong;
  }
}

TEST(ConstantTime, EqualTextsAreEqualAndOthersNot) {
  EXPECT_TRUE(equal_in_constant_time("", ""));
  EXPECT_TRUE(equal_in_constant_time("abc", "abc"));
  EXPECT_FALSE(equal_in_constant_time("abc", "abd"));
  EXPECT_FALSE(equal_in_constant_time("abc", "ab"));
  EXPECT_FALSE(equal_in_constant_time("", "a"));
  EXPECT_FALSE(equal_in_constant_time(std::string("a\0", 2), "a"));
}

}  // namespace
}  // namespace pharos::tools
