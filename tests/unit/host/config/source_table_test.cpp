// SPDX-License-Identifier: Apache-2.0
#include "host/config/source_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pharos::host {
namespace {

using ::testing::ElementsAre;

TEST(SourceTable, HasEverySourceUnderTheNameOfItsMessages) {
  DaemonConfig config;
  config.source = "chaser";
  config.targets.resize(2);
  config.targets[0].name = "dock";
  config.targets[0].port = "/dev/ttyUSB0";
  config.targets[1].name = "old";
  config.targets[1].port = "replay:a.bin";
  config.targets[1].method = TrackMethod::kEpoch;
  config.cameras.resize(1);
  config.cameras[0].name = "helios";
  config.cameras[0].target = "client";
  config.cameras[0].device.serial = "2333";
  config.cameras[0].average_frames = 10;
  config.stereos.resize(1);
  config.stereos[0].name = "bow";
  config.stereos[0].target = "client";
  config.stereos[0].ring2 = true;
  config.stereos[0].slam.emplace();
  config.stereos[0].frames = "pairs";
  config.telescopes.resize(1);
  config.telescopes[0].name = "dome";
  config.telescopes[0].target = "far";
  config.telescopes[0].directory = "spool";
  EXPECT_THAT(source_table(config), ElementsAre("SOURCE                    TARGET  INPUT                      MEASURES "
                                                "                                    CHANNEL",
                                                "lighthouse/chaser         dock    /dev/ttyUSB0, 460800 baud  pose in "
                                                "each station's frame, a sweep        PHAROS_LIGHTHOUSE_POSE",
                                                "lighthouse/chaser/replay  old     recording a.bin            pose in "
                                                "each station's frame, a cycle        PHAROS_LIGHTHOUSE_POSE",
                                                "tof/helios                client  serial number 2333         pose of "
                                                "the docking ring, mean of 10 frames  PHAROS_TOF_POSE",
                                                "ring2/bow                 client  pairs pairs                pose of "
                                                "ring and nozzle, a pair              PHAROS_RING2_POSE",
                                                "slam/bow                  client  pairs pairs                pose "
                                                "relative to the first pair, spin        PHAROS_SLAM_POSE",
                                                "line/dome                 far     images spool               panel "
                                                "axis, an image                         PHAROS_LINE_POINTING"));
}

}  // namespace
}  // namespace pharos::host
