// SPDX-License-Identifier: Apache-2.0
// MCAP files read by @mcap/core, the library of the format's authors.
#include <gtest/gtest.h>

#include "exported.hpp"

namespace pharos::tools {
namespace {

TEST(McapPeer, ReadsTheSameMessagesThroughTheIndex) {
  const test::TemporaryFolder folder;
  const std::string install =
      "cd " + folder.path().string() + " && npm install --silent --no-audit --no-fund @mcap/core >npm.log 2>&1";
  if (std::system(install.c_str()) != 0) GTEST_SKIP() << "npm cannot get @mcap/core (no npm, or no network)";
  std::ifstream script(PHAROS_READ_MCAP_PEER);
  const std::string text{std::istreambuf_iterator<char>(script), {}};
  const std::string program = folder.write("read_mcap.mjs", text);  // beside node_modules
  const std::string path = folder.path("log.mcap");
  test::export_log(folder, test::example_log(), path);
  test::expect_example(test::read_back(folder, "node " + program + " " + path));
}

}  // namespace
}  // namespace pharos::tools
