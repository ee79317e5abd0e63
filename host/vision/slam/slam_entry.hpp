// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/vision/slam/rectification.hpp"
#include "host/vision/slam/slam_system.hpp"
#include "host/vision/slam/vocabulary.hpp"

namespace pharos::slam {

/// What a system is made of, read and checked before the module is loaded.
struct SlamParts {
  const Rectification* rectification;
  const Vocabulary* vocabulary;
  const SlamSettings* settings;
};

/// Both sides of the module's border are of one build: whole classes may cross it.
inline constexpr const char* kSlamModule = "libpharos_slam_module.so";
inline constexpr const char* kSlamFunction = "pharos_make_slam";
inline constexpr const char* kDescribeFunction = "pharos_describe_image";
using SlamFunction = SlamSystem* (*)(const SlamParts&);
using DescribeFunction = void (*)(ImageView<const std::uint8_t> image, int features, std::vector<Descriptor>& out);

}  // namespace pharos::slam
