// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/engine.hpp"

namespace pharos::slam {

std::vector<Descriptor> describe_image(ImageView<const std::uint8_t> image, int features) {
  OrbSettings settings;
  settings.features = features;
  OrbExtractor extractor(settings);
  std::vector<Descriptor> descriptors;
  for (const Feature& feature : extractor.extract(image, {})) descriptors.push_back(feature.descriptor);
  return descriptors;
}

std::unique_ptr<SlamSystem> make_slam(const host::RigFile& rig, const std::string& rig_name,
                                      const SlamSettings& settings) {
  Rectification rectification = rectify(rig, rig_name);
  Vocabulary vocabulary =
      Vocabulary::read(settings.vocabulary.empty() ? shipped_vocabulary_path() : settings.vocabulary);
  return std::make_unique<Engine>(std::move(rectification), std::move(vocabulary), settings);
}

}  // namespace pharos::slam
