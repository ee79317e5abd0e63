// SPDX-License-Identifier: Apache-2.0
#include "tools/init/first_config.hpp"

#include <gtest/gtest.h>

#include "host/config/load_config.hpp"
#include "tests/support/temporary_folder.hpp"

namespace pharos::tools {
namespace {

TEST(FirstConfig, IsUnderstoodAsItWasMeant) {
  const test::TemporaryFolder folder;
  const std::string sensors =
      folder.write("a \"b\" \\.csv", "sensor,x_m,y_m,z_m\n0,0,0,0\n1,0.1,0,0\n2,0,0.1,0\n3,0,0,0.1\n");
  const std::string lens = folder.write("lens.toml",
                                        "width_px = 640\nheight_px = 480\nfx_px = 460.0\nfy_px = 460.0\ncx_px = 319.5\n"
                                        "cy_px = 239.5\ndistortion = [0.0, 0.0, 0.0, 0.0, 0.0]\n");
  FirstConfig config;
  config.targets.push_back({"dock", "/dev/ttyUSB7", sensors, 230'400, "0A1B2C3D", 12});
  config.cameras.push_back({"helios", "client", lens, "233300001", ""});
  config.cameras.push_back({"second", "client", lens, "", "169.254.1.2"});
  const auto read =
      host::parse_daemon_config(config_text(config), "first.toml", folder.path(), host::host_environment());
  ASSERT_EQ(read.targets.size(), 1U);
  EXPECT_EQ(read.targets[0].name, "dock");
  EXPECT_EQ(read.targets[0].port, "/dev/ttyUSB7");
  EXPECT_EQ(read.targets[0].baud, 230'400);
  EXPECT_EQ(read.targets[0].target.size(), 4U);
  EXPECT_EQ(read.targets[0].identity.serial, 0xA1B2C3DU);
  EXPECT_EQ(read.targets[0].identity.sensors, 12);
  ASSERT_EQ(read.cameras.size(), 2U);
  EXPECT_EQ(read.cameras[0].device.serial, "233300001");
  EXPECT_EQ(read.cameras[1].device.address, "169.254.1.2");
  EXPECT_EQ(read.cameras[1].target, "client");
}

TEST(FirstConfig, NamesAreThoseThatAConfigurationTakes) {
  EXPECT_EQ(config_name("target 12 (left)", "target"), "target12left");
  EXPECT_EQ(config_name("\xC3\xA9.", "target"), "target");
}

}  // namespace
}  // namespace pharos::tools
