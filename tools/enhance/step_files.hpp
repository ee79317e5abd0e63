// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "host/images/picture.hpp"
#include "host/vision/enhance/enhancer.hpp"

namespace pharos::tools {

/// A picture as floats, 0 ... 1.
enhance::FloatImage light_of(const host::Picture& picture);

/// The picture of `light`, clipped to 0 ... 1, with `bits` a value.
host::Picture picture_of(const enhance::FloatImage& light, int bits);

/// File for each step of an enhancement; empty: not written.
struct StepFiles {
  std::string start, refined, illumination, reflectance, denoised;

  bool any() const { return !names().empty(); }
  /// Those that are given.
  std::vector<std::string> names() const;
  /// 16 bits each, whatever the frame's. Throws InputError where one cannot be written.
  void write(const enhance::Enhanced& steps) const;
  /// The same for a folder of images: the names are folders, each with a file for frame `name`.
  StepFiles inside(const std::string& name) const;
};

}  // namespace pharos::tools
