// SPDX-License-Identifier: Apache-2.0
#include "tools/enhance/step_files.hpp"

#include <algorithm>
#include <filesystem>

namespace pharos::tools {

using enhance::FloatImage;

FloatImage light_of(const host::Picture& picture) {
  constexpr float kStep = 1.0F / 65535.0F;
  FloatImage light;
  light.shape(picture.width_px, picture.height_px, picture.channels);
  const auto channels = static_cast<std::size_t>(picture.channels);
  for (std::size_t c = 0; c < channels; ++c) {
    float* plane = light.plane(static_cast<int>(c));
    for (std::size_t k = 0; k < light.pixels(); ++k) {
      plane[k] = kStep * static_cast<float>(picture.values[k * channels + c]);
    }
  }
  return light;
}

host::Picture picture_of(const FloatImage& light, int bits) {
  host::Picture picture{light.width_px, light.height_px, light.channels, bits, {}};
  picture.values.resize(light.values.size());
  const auto channels = static_cast<std::size_t>(light.channels);
  const float maximum = bits == 16 ? 65535.0F : 255.0F;
  const int widen = bits == 16 ? 1 : 257;
  for (std::size_t c = 0; c < channels; ++c) {
    const float* plane = light.plane(static_cast<int>(c));
    for (std::size_t k = 0; k < light.pixels(); ++k) {
      const int value = static_cast<int>(std::clamp(plane[k], 0.0F, 1.0F) * maximum + 0.5F);
      picture.values[k * channels + c] = static_cast<std::uint16_t>(value * widen);
    }
  }
  return picture;
}

std::vector<std::string> StepFiles::names() const {
  std::vector<std::string> given;
  for (const std::string& name : {start, refined, illumination, reflectance, denoised}) {
    if (!name.empty()) given.push_back(name);
  }
  return given;
}

namespace {

FloatImage divided(FloatImage image, float by) {
  for (float& value : image.values) value /= by;
  return image;
}

}  // namespace

void StepFiles::write(const enhance::Enhanced& steps) const {
  const auto put = [](const std::string& path, const FloatImage& step) {
    if (!path.empty()) host::write_picture(path, picture_of(step, 16));
  };
  put(start, steps.start);
  put(refined, steps.refined);
  put(illumination, steps.illumination);
  if (!reflectance.empty()) put(reflectance, divided(steps.reflectance, steps.peak));
  put(denoised, steps.denoised);
}

StepFiles StepFiles::inside(const std::string& name) const {
  const auto in = [&](const std::string& folder) {
    return folder.empty() ? folder : (std::filesystem::path(folder) / name).string();
  };
  return {in(start), in(refined), in(illumination), in(reflectance), in(denoised)};
}

}  // namespace pharos::tools
