// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/stereo_tumbling/povray_panels.hpp"

#include <cmath>
#include <filesystem>

#include "host/images/grey_image.hpp"
#include "host/support/exact_number.hpp"
#include "tools/sim/povray/scene_text.hpp"

namespace pharos::sim {
namespace {

std::string texture_file(const std::string& folder, int number) {
  return (std::filesystem::absolute(folder) / ("texture_" + std::to_string(number) + ".png")).string();
}

std::string triangle(const Vector3& a, const Vector3& b, const Vector3& c, const char* maps) {
  return "triangle { " + povray_vector(a) + ", " + povray_vector(b) + ", " + povray_vector(c) + " uv_vectors " + maps +
         " }\n";
}

}  // namespace

void write_texture_files(const PanelScene& scene, const std::string& folder) {
  for (std::size_t k = 0; k < scene.textures.size(); ++k) {
    const Texture& texture = scene.textures[k];
    std::vector<std::uint16_t> grey;
    grey.reserve(texture.albedo.size());
    for (const float albedo : texture.albedo)
      grey.push_back(static_cast<std::uint16_t>(std::lround(albedo * 65535.0F)));
    host::write_grey_png(texture_file(folder, static_cast<int>(k)), {grey.data(), texture.width, texture.height}, 16);
  }
}

std::string povray_panels(const PanelScene& scene, const Lighting& lighting, const std::string& texture_folder,
                          double gloss) {
  std::string text;
  if (lighting.diffuse > 0.0) {
    text += "light_source { " + povray_vector(lighting.lamp_m) + " rgb 1 shadowless }\n";
  }
  for (const Panel& panel : scene.panels) {
    const Vector3 a = panel.corner_m, b = a + panel.edge_s_m, d = a + panel.edge_t_m, c = b + panel.edge_t_m;
    // An image map's v grows upwards from the picture's last row.
    text += "mesh {\n" + triangle(a, b, c, "<0, 1>, <1, 1>, <1, 0>") + triangle(a, c, d, "<0, 1>, <1, 0>, <0, 0>") +
            "texture { uv_mapping pigment { image_map { png \"" + texture_file(texture_folder, panel.texture) +
            "\" gamma 1.0 interpolate 2 } } finish { ambient 0 emission " + host::exact_number(lighting.ambient) +
            " diffuse " + host::exact_number(lighting.diffuse) + " specular " +
            host::exact_number(lighting.diffuse > 0.0 ? gloss : 0.0) + " roughness 0.05 } }\n}\n";
  }
  return text;
}

}  // namespace pharos::sim
