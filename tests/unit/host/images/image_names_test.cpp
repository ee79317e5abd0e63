// SPDX-License-Identifier: Apache-2.0
#include "host/images/image_names.hpp"

#include <gtest/gtest.h>

namespace pharos::host {
namespace {

TEST(ImageNames, EndingsOfEveryFormatInAnyCase) {
  for (const char* name : {"a.png", "b.TIF", "c.tiff", "d.pgm", "e.ppm", "f.pnm", "g.Jpg", "h.jpeg", "dir/i.BMP"}) {
    EXPECT_TRUE(has_image_ending(name)) << name;
  }
  for (const char* name : {"png", ".png", "a.png.gz", "a.gif", "a", "a.png~", ""}) {
    EXPECT_FALSE(has_image_ending(name)) << name;
  }
}

}  // namespace
}  // namespace pharos::host
