// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/camera/make_sequence.hpp"

#include <algorithm>
#include <utility>

#include "host/cameras/camera_file.hpp"
#include "host/device/frame_directory.hpp"
#include "host/device/pair_names.hpp"
#include "host/files/atomic_file.hpp"
#include "host/images/grey_image.hpp"
#include "host/support/input_error.hpp"
#include "tools/sim/optics/ray_grid.hpp"
#include "tools/sim/tof/tof_simulator.hpp"

namespace pharos::sim {
namespace {

std::vector<std::array<float, 2>> rays_of(const Lens& lens) {
  const RayGrid grid = RayGrid::pixel_centres(lens, 0);
  std::vector<std::array<float, 2>> rays;
  for (int v = 0; v < grid.rows(); ++v) {
    for (int u = 0; u < grid.columns(); ++u) {
      rays.push_back({static_cast<float>(grid.at(u, v).x()), static_cast<float>(grid.at(u, v).y())});
    }
  }
  return rays;
}

}  // namespace

FrameSequence sequence_of_scenario(const std::string& scenario, std::uint64_t seed, std::size_t maximum,
                                   const std::filesystem::path& camera_file, const std::function<void()>& made) {
  TofSimulator simulator(read_tof_scenario(scenario, seed), seed);
  const TofScenario& about = simulator.scenario();
  FrameSequence sequence{about.lens.width_px, about.lens.height_px, about.depth.scale_m, rays_of(about.lens), {}};
  if (!camera_file.empty()) {
    host::CameraFile file;
    file.camera.intrinsics = optics_as<PinholeCamera>(about.lens);
    file.camera.depth_scale_m = about.depth.scale_m;
    file.camera.depth_origin_z_m = about.depth.origin_z_m;
    host::write_file(camera_file.string(), host::camera_text(file));
  }
  const std::size_t count = std::min(maximum, static_cast<std::size_t>(simulator.frames()));
  for (std::size_t i = 0; i < count; ++i) {
    TofPixels pixels = simulator.pixels(static_cast<int>(i));
    sequence.frames.push_back(
        {std::move(pixels.intensity), std::move(pixels.depth), simulator.truth(static_cast<int>(i)).T_camera_target});
    made();
  }
  return sequence;
}

FrameSequence sequence_of_directory(const std::string& directory, std::size_t maximum) {
  const DepthCamera camera = host::read_camera_file(directory + "/camera.toml").camera;
  const host::FrameDirectory files(directory);
  FrameSequence sequence{camera.intrinsics.width_px,
                         camera.intrinsics.height_px,
                         camera.depth_scale_m,
                         rays_of(lens_of(camera.intrinsics)),
                         {}};
  for (std::size_t i = 0; i < std::min(maximum, files.frames()); ++i) {
    host::DepthFrame frame;
    files.read(i, sequence.width_px, sequence.height_px, frame);
    sequence.frames.push_back({std::move(frame.intensity), std::move(frame.depth), std::nullopt});
  }
  return sequence;
}

FrameSequence sequence_of_pairs(const std::string& directory, std::size_t side, std::size_t maximum) {
  FrameSequence sequence;
  for (const host::PairName& pair : host::pair_names_in(directory, 1.0)) {
    if (sequence.frames.size() == maximum) break;
    const std::string& file = side == 0 ? pair.left : pair.right;
    host::GreyImage image = host::read_grey_image(file);
    if (sequence.frames.empty()) {
      sequence.width_px = image.width_px;
      sequence.height_px = image.height_px;
    } else if (image.width_px != sequence.width_px || image.height_px != sequence.height_px) {
      throw host::InputError(file + ": is of another size than the image before it; a camera has one");
    }
    sequence.frames.push_back({std::move(image.pixels), {}, std::nullopt});
  }
  return sequence;
}

}  // namespace pharos::sim
