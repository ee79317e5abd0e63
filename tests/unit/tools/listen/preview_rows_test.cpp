// SPDX-License-Identifier: Apache-2.0
#include "tools/listen/preview_rows.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "pharos/preview_t.hpp"

namespace pharos::tools {
namespace {

preview_t of_a_rig() {
  preview_t preview{};
  preview.utime = 1'700'000'000'123'456;
  preview.sequence = 9;
  preview.source = "ring2/bow";
  preview.station_or_camera = "bow";
  preview.view = "left";
  preview.target = "client\xFF";  // of another program: no UTF-8
  preview.status = "refused_left_black";
  preview.width_px = 1280;
  preview.height_px = 960;
  preview.format = "jpeg";
  preview.data.assign(2048, 0xD8);
  preview.size = 2048;
  return preview;
}

TEST(PreviewRows, ALineTellsWhosePictureItIsAndHowLarge) {
  preview_t preview = of_a_rig();
  preview.target = "client";
  EXPECT_EQ(preview_line(preview),
            "22:13:20.123 client picture of ring2/bow left: refused_left_black, 1280 x 960 px, 2.0 KiB");
  preview.view.clear();
  EXPECT_EQ(preview_line(preview),
            "22:13:20.123 client picture of ring2/bow: refused_left_black, 1280 x 960 px, 2.0 KiB");
}

TEST(PreviewRows, JsonIsTheMessageWithoutItsPicture) {
  const auto json = nlohmann::json::parse(preview_json(of_a_rig()));
  EXPECT_EQ(json["source"], "ring2/bow");
  EXPECT_EQ(json["view"], "left");
  EXPECT_EQ(json["size"], 2048);
  EXPECT_EQ(json["utime"], 1'700'000'000'123'456);
  EXPECT_FALSE(json.contains("data"));
}

}  // namespace
}  // namespace pharos::tools
