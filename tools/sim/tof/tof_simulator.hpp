// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "tools/sim/tof/tof_scenario.hpp"

namespace pharos::sim {

/// One frame of the simulated camera and the truth of it.
struct TofTruth {
  int frame = 0;
  double time_s = 0.0;
  CameraFromTarget T_camera_target;
  PaperAngles angles;
};

/// The simulated camera before the simulated satellite. Frames may be asked for in any order: the same scenario, seed
/// and number give the same pixels. About 50 ms a frame on one core; 15 ms where the pose is that of the frame before.
class TofSimulator {
 public:
  /// Throws host::InputError where the lens cannot be (see PixelRays).
  TofSimulator(TofScenario scenario, std::uint64_t seed);
  /// The same with rays of its lens and a foil of its own: making those takes half of a frame's time.
  TofSimulator(TofScenario scenario, std::uint64_t seed, std::shared_ptr<const PixelRays> rays, FoilTexture foil);

  const TofScenario& scenario() const { return scenario_; }
  const PixelRays& rays() const { return *rays_; }
  int frames() const { return static_cast<int>(scenario_.poses.size()); }

  TofTruth truth(int frame) const;
  TofPixels pixels(int frame);
  /// The light before noise.
  const IdealFrame& ideal(int frame);

 private:
  std::optional<Occluder> occluder_of(int frame) const;
  TofPixels fresh_pixels(int frame);

  TofScenario scenario_;
  std::uint64_t seed_;
  std::shared_ptr<const PixelRays> rays_;
  FoilTexture foil_;
  IdealFrame ideal_;
  int rendered_ = -1;  // frame of ideal_
};

/// The raw form of LUCID's Coord3D_ABCY16: X, Y, Z, intensity of each pixel, little-endian; 0xFFFF where invalid.
/// mm = count * scale + offset, metres here.
struct RawCoordinates {
  std::array<double, 3> scale_m{0.00025, 0.00025, 0.00025};
  std::array<double, 3> offset_m{-8.192, -8.192, 0.0};
};
std::vector<std::uint8_t> abcy16_of(const TofPixels& pixels, const PixelRays& rays, const DepthScale& depth,
                                    const RawCoordinates& raw);

}  // namespace pharos::sim
