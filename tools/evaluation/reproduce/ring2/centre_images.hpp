// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "tools/evaluation/report/part.hpp"

namespace pharos::tools {

/// Figure 7 of paper 001: both images with the target turned by 1 deg about Y (a) and about X (b); how far the
/// ellipses' middles are from the images of the circles' centres. With `folder` also the pictures.
void add_centre_images(report::PartResult& result, const std::filesystem::path& folder);

}  // namespace pharos::tools
