// SPDX-License-Identifier: Apache-2.0
#include "host/config/lcm_url.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pharos::host {
namespace {

using ::testing::HasSubstr;

TEST(LcmUrl, TakesWhatLcmUnderstands) {
  for (const char* url : {"udpm://239.255.76.67:7667?ttl=0", "udpm://", "udpm://:7000", "udpm://224.0.0.1",
                          "udpm://239.255.76.67:7667?recv_buf_size=2097152&ttl=1", "udpm://?ttl=255",
                          "file:///var/log/pharos.lcm?mode=w", "file://x.lcm?mode=a"}) {
    EXPECT_EQ(lcm_url_error(url), "") << url;
  }
}

struct BadUrl {
  const char* url;
  const char* words;
};

TEST(LcmUrl, RefusesInvalidValuesAndNamesThem) {
  for (const BadUrl& bad : {BadUrl{"udpm://239.255.76:7667", "no multicast address"},
                            BadUrl{"udpm://127.0.0.1:7667", "no multicast address"},
                            BadUrl{"udpm://240.0.0.1:7667", "no multicast address"},
                            BadUrl{"udpm://localhost:7667", "no multicast address"},
                            BadUrl{"udpm://239.255.76.67:", "no port"},
                            BadUrl{"udpm://239.255.76.67:0", "no port"},
                            BadUrl{"udpm://239.255.76.67:65536", "no port"},
                            BadUrl{"udpm://239.255.76.67:76a", "no port"},
                            BadUrl{"udpm://239.255.76.67:7667:1", "no port"},
                            BadUrl{"udpm://239.255.76.67:7667?ttl=256", "must be 0"},
                            BadUrl{"udpm://239.255.76.67:7667?ttl=", "must be 0"},
                            BadUrl{"udpm://239.255.76.67:7667?tll=1", "no option of udpm"},
                            BadUrl{"udpm://239.255.76.67:7667?recv_buf_size=-1", "in bytes"},
                            BadUrl{"file://", "names no file"},
                            BadUrl{"file:///tmp/x", "would be read"},
                            BadUrl{"file:///tmp/x?mode=r", "would be read"},
                            BadUrl{"tcpq://127.0.0.1:7700", "would hold up every pose"},
                            BadUrl{"memq://", "nobody listens"},
                            BadUrl{"http://x", "must begin with"},
                            BadUrl{"", "must begin with"}}) {
    EXPECT_THAT(lcm_url_error(bad.url), HasSubstr(bad.words)) << bad.url;
  }
  EXPECT_THAT(lcm_url_error(std::string("udpm://\0", 8)), HasSubstr("zero"));
}

}  // namespace
}  // namespace pharos::host
