// SPDX-License-Identifier: Apache-2.0
// The module's entries.
#include "host/vision/slam/engine.hpp"
#include "host/vision/slam/slam_entry.hpp"

extern "C" void pharos_describe_image(pharos::ImageView<const std::uint8_t> image, int features,
                                      std::vector<pharos::slam::Descriptor>& out) {
  pharos::slam::OrbSettings settings;
  settings.features = features;
  pharos::slam::OrbExtractor extractor(settings);
  for (const pharos::slam::Feature& feature : extractor.extract(image, {})) out.push_back(feature.descriptor);
}

extern "C" pharos::slam::SlamSystem* pharos_make_slam(const pharos::slam::SlamParts& parts) {
  return new pharos::slam::Engine(*parts.rectification, *parts.vocabulary, *parts.settings);  // the caller owns it
}
