// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/tof/tof_simulator.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace pharos::sim {
namespace {

constexpr double kClearOfConnector_deg = 85.0;  // a third of the ring is 60 deg to each side

// A direction whose hidden arc leaves every connector in sight.
double draw_direction(const Satellite& satellite, RandomStream random) {
  for (;;) {
    const double direction = random.uniform(0.0, 360.0);
    const bool clear = std::all_of(satellite.connectors.begin(), satellite.connectors.end(), [&](const Connector& c) {
      return std::abs(std::remainder(direction - c.direction_deg, 360.0)) > kClearOfConnector_deg;
    });
    if (clear) return direction;
  }
}

std::string purpose(const char* what, int frame) { return "tof " + std::string(what) + ' ' + std::to_string(frame); }

}  // namespace

TofSimulator::TofSimulator(TofScenario scenario, std::uint64_t seed)
    : scenario_(std::move(scenario)),
      seed_(seed),
      rays_(std::make_shared<const PixelRays>(scenario_.lens)),
      foil_(scenario_.satellite.foil.height_m, RandomStream(seed, "tof foil")) {}

TofSimulator::TofSimulator(TofScenario scenario, std::uint64_t seed, std::shared_ptr<const PixelRays> rays,
                           FoilTexture foil)
    : scenario_(std::move(scenario)), seed_(seed), rays_(std::move(rays)), foil_(std::move(foil)) {}

TofTruth TofSimulator::truth(int frame) const {
  const CameraFromTarget& pose = scenario_.poses[static_cast<std::size_t>(frame)];
  return {frame, frame / scenario_.frames_per_s, pose, angles_of(pose.R)};
}

std::optional<Occluder> TofSimulator::occluder_of(int frame) const {
  std::optional<Occluder> occluder = scenario_.satellite.occluder;
  if (occluder && scenario_.occluder_wanders) {
    occluder->direction_deg = draw_direction(scenario_.satellite, RandomStream(seed_, purpose("occluder", frame)));
  }
  return occluder;
}

const IdealFrame& TofSimulator::ideal(int frame) {
  const auto pose = [this](int number) -> const CameraFromTarget& {
    return scenario_.poses[static_cast<std::size_t>(number)];
  };
  const bool same = rendered_ >= 0 && pose(rendered_).R == pose(frame).R && pose(rendered_).t == pose(frame).t &&
                    !(scenario_.occluder_wanders && scenario_.satellite.occluder);
  if (!same) {
    Satellite satellite = scenario_.satellite;
    satellite.occluder = occluder_of(frame);
    ideal_ = render_ideal(Scene(satellite, foil_, pose(frame)), *rays_, scenario_.imaging);
  }
  rendered_ = frame;
  return ideal_;
}

TofPixels TofSimulator::fresh_pixels(int frame) {
  return expose(ideal(frame), *rays_, scenario_.sensor, scenario_.imaging.nominal_counts, scenario_.depth,
                RandomStream(seed_, purpose("noise", frame)));
}

TofPixels TofSimulator::pixels(int frame) {
  TofPixels pixels = fresh_pixels(frame);
  const int every = scenario_.stale_half_every;
  if (every > 0 && frame > 0 && frame % every == 0) {
    const TofPixels before = fresh_pixels(frame - 1);
    const auto half = static_cast<std::ptrdiff_t>(pixels.depth.size() / 2);
    std::copy(before.depth.begin() + half, before.depth.end(), pixels.depth.begin() + half);
    std::copy(before.intensity.begin() + half, before.intensity.end(), pixels.intensity.begin() + half);
  }
  return pixels;
}

std::vector<std::uint8_t> abcy16_of(const TofPixels& pixels, const PixelRays& rays, const DepthScale& depth,
                                    const RawCoordinates& raw) {
  constexpr std::uint16_t kNone = 0xFFFF;
  std::vector<std::uint8_t> bytes;
  bytes.reserve(pixels.depth.size() * 8);
  const auto put = [&bytes](std::uint16_t value) {
    bytes.push_back(static_cast<std::uint8_t>(value & 0xFF));
    bytes.push_back(static_cast<std::uint8_t>(value >> 8));
  };
  for (int v = 0; v < pixels.height_px; ++v) {
    for (int u = 0; u < pixels.width_px; ++u) {
      const std::size_t i =
          static_cast<std::size_t>(v) * static_cast<std::size_t>(pixels.width_px) + static_cast<std::size_t>(u);
      const bool valid = pixels.depth[i] != 0;
      const double z = pixels.depth[i] * depth.scale_m;
      const double from_centre = z + depth.origin_z_m;
      const Vector3 point(rays.ray(u, v).x() * from_centre, rays.ray(u, v).y() * from_centre, z);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double count =
            std::round((point[static_cast<Eigen::Index>(axis)] - raw.offset_m[axis]) / raw.scale_m[axis]);
        put(valid && count >= 0.0 && count < kNone ? static_cast<std::uint16_t>(count) : kNone);
      }
      put(pixels.intensity[i]);
    }
  }
  return bytes;
}

}  // namespace pharos::sim
