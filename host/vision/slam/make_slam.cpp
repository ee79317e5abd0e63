// SPDX-License-Identifier: Apache-2.0
#include "host/support/module_function.hpp"
#include "host/vision/slam/slam_entry.hpp"

namespace pharos::slam {

std::vector<Descriptor> describe_image(ImageView<const std::uint8_t> image, int features) {
  static const auto describe =
      reinterpret_cast<DescribeFunction>(host::module_function(kSlamModule, kDescribeFunction));
  std::vector<Descriptor> out;
  describe(image, features, out);
  return out;
}

std::unique_ptr<SlamSystem> make_slam(const host::RigFile& rig, const std::string& rig_name,
                                      const SlamSettings& settings) {
  const Rectification rectification = rectify(rig, rig_name);
  const Vocabulary vocabulary =
      Vocabulary::read(settings.vocabulary.empty() ? shipped_vocabulary_path() : settings.vocabulary);
  const auto make = reinterpret_cast<SlamFunction>(host::module_function(kSlamModule, kSlamFunction));
  return std::unique_ptr<SlamSystem>(make({&rectification, &vocabulary, &settings}));
}

}  // namespace pharos::slam
