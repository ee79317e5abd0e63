// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/slam/colour_pairs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/images/picture.hpp"
#include "host/vision/enhance/enhancer.hpp"
#include "host/vision/enhance/luma.hpp"
#include "host/vision/slam/slam_system.hpp"
#include "tools/evaluation/low_light/low_light_peers.hpp"
#include "tools/evaluation/reproduce/slam/nees.hpp"
#include "tools/sim/stereo_tumbling/tumbling_sequence.hpp"
#include "tools/support/progress.hpp"

namespace pharos::tools {
namespace {

using enhance::FloatImage;

constexpr int kViewsApart = 10;  // frames of 0.5 deg
constexpr double kDarkest = 0.01, kLow = 0.1;
constexpr double kTracked_deg = 10.0;

// What is made of a colour image before features are looked for.
enum class Way : std::uint8_t { kAsItIs, kOfLuma, kOfColours };
constexpr std::array<Way, 3> kWays = {Way::kAsItIs, Way::kOfLuma, Way::kOfColours};

sim::TumblingScenario colour_scenario(double ambient) {
  sim::TumblingScenario scenario;
  scenario.turn_deg = kTracked_deg;
  scenario.good_light = false;
  scenario.ambient = ambient;
  scenario.povray = false;
  return scenario;
}

FloatImage colours_of(sim::TumblingSequence& sequence, int frame, int side) {
  const std::array<host::GreyImage, 3> planes = sequence.colour_image(frame, side);
  FloatImage colours;
  colours.shape(planes[0].width_px, planes[0].height_px, 3);
  for (std::size_t c = 0; c < planes.size(); ++c) {
    std::transform(planes[c].pixels.begin(), planes[c].pixels.end(), colours.plane(static_cast<int>(c)),
                   [](std::uint16_t value) { return static_cast<float>(value) / 65535.0F; });
  }
  return colours;
}

GreyBytes luma_bytes(const FloatImage& image) {
  FloatImage luma;
  enhance::luma_of(image, luma);
  GreyBytes bytes(luma.pixels());
  enhance::to_integers(luma.view(), ImageView<std::uint8_t>(bytes.data(), luma.width_px, luma.height_px));
  return bytes;
}

// One camera's images, each way; enhanced() is the last of Way::kOfColours.
class ColourCamera {
 public:
  explicit ColourCamera(enhance::Denoiser denoiser) {
    enhance::EnhanceSettings settings;
    settings.denoiser = denoiser;
    for (auto& enhancer : enhancers_) enhancer = std::make_unique<enhance::Enhancer>(settings);
  }
  GreyBytes of(Way way, const FloatImage& colours) {
    if (way == Way::kAsItIs) return luma_bytes(colours);
    if (way == Way::kOfColours) {
      enhanced_ = enhancers_[1]->enhance(colours).result;
      return luma_bytes(enhanced_);
    }
    FloatImage luma;
    enhance::luma_of(colours, luma);
    return luma_bytes(enhancers_[0]->enhance(luma).result);
  }
  const FloatImage& enhanced() const { return enhanced_; }

 private:
  FloatImage enhanced_;
  std::array<std::unique_ptr<enhance::Enhancer>, 2> enhancers_;
};

void write_colours(const FloatImage& image, const std::filesystem::path& path) {
  host::Picture picture{image.width_px, image.height_px, 3, 8, {}};
  for (std::size_t k = 0; k < image.pixels(); ++k) {
    for (int c = 0; c < 3; ++c) {
      const float value = std::clamp(image.plane(c)[k], 0.0F, 1.0F);
      picture.values.push_back(static_cast<std::uint16_t>(std::lround(255.0F * value) * 257));
    }
  }
  host::write_picture(path.string(), picture);
}

void add_views(std::uint64_t seed, const std::filesystem::path& folder, report::PartResult& result) {
  sim::TumblingSequence sequence(colour_scenario(kDarkest), seed);
  const FloatImage first = colours_of(sequence, 0, 0), second = colours_of(sequence, kViewsApart, 0);
  ColourCamera camera(enhance::Denoiser::kBm3d);
  std::array<double, kWays.size()> matches{};
  for (std::size_t k = 0; k < kWays.size(); ++k) {
    const GreyBytes before = camera.of(kWays[k], first);
    if (kWays[k] == Way::kOfColours && !folder.empty()) {
      write_colours(first, folder / "colour_dark.png");
      write_colours(camera.enhanced(), folder / "colour_lime.png");
      result.pictures.push_back({"figure 4", "in colour, as it is", "colour_dark.png"});
      result.pictures.push_back({"figure 4", "in colour, LIME with BM3D on Y", "colour_lime.png"});
    }
    matches[k] = inliers_of_orb(before, camera.of(kWays[k], second), first.width_px, first.height_px);
  }
  const auto add = [&](const char* name, double other, const char* remark) {
    ComparisonRow row{"figure 4", std::string("in colour, ") + name + ": ORB matches of two views",
                      "",         "",
                      matches[2], std::string("ours: LIME of the colours") + remark};
    row.theirs = other;
    result.rows.push_back(row);
  };
  add("as it is", matches[0], "");
  add("LIME of the luma", matches[1], "; as `pharos slam --enhance` treats colour images");
}

struct Tracked {
  double rmse_deg = 0.0;
  int placed = 0, pairs = 0;
};

Tracked tracked(const slam::SlamSystem& system, const sim::TumblingSequence& sequence) {
  Tracked out;
  for (const slam::TrackedFrame& frame : system.optimised_trajectory()) {
    ++out.pairs;
    if (!frame.placed) continue;
    ++out.placed;
    const double off_deg = kDegreesPerRadian * rotation_angle_between(frame.placed->pose.R,
                                                                      sequence.truth(static_cast<int>(frame.number)).R);
    out.rmse_deg += off_deg * off_deg;
  }
  out.rmse_deg = std::sqrt(out.rmse_deg / std::max(1, out.placed));
  return out;
}

void add_tracking(std::uint64_t seed, report::PartResult& result) {
  sim::TumblingSequence sequence(colour_scenario(kLow), seed);
  std::array<std::unique_ptr<slam::SlamSystem>, kWays.size()> systems;
  for (auto& system : systems) system = slam::make_slam(sequence.rig(), "the simulated rig", {});
  std::array<ColourCamera, 2> cameras = {ColourCamera(enhance::Denoiser::kFast),
                                         ColourCamera(enhance::Denoiser::kFast)};
  Progress progress("paper 004, colour", "pairs", static_cast<std::size_t>(sequence.frames()));
  for (int frame = 0; frame < sequence.frames(); ++frame) {
    const std::array<FloatImage, 2> pair = {colours_of(sequence, frame, 0), colours_of(sequence, frame, 1)};
    for (std::size_t k = 0; k < kWays.size(); ++k) {
      const GreyBytes left = cameras[0].of(kWays[k], pair[0]), right = cameras[1].of(kWays[k], pair[1]);
      const auto view = [&pair](const GreyBytes& bytes) {
        return ImageView<const std::uint8_t>(bytes.data(), pair[0].width_px, pair[0].height_px);
      };
      systems[k]->push(0.05 * frame, view(left), view(right));
    }
    progress.step();
  }
  constexpr std::array<const char*, kWays.size()> kNames = {"as they are", "LIME of the luma", "LIME of the colours"};
  for (std::size_t k = 0; k < kWays.size(); ++k) {
    const Tracked outcome = tracked(*systems[k], sequence);
    ComparisonRow row{"figure 4",
                      std::string("colour pairs over 10 deg, ") + kNames[k] + ": attitude RMSE",
                      "deg",
                      "",
                      std::nullopt,
                      std::to_string(outcome.placed) + " of " + std::to_string(outcome.pairs) +
                          " pairs tracked, ambient light 0.1, fast denoiser"};
    if (outcome.placed > 0) row.ours = outcome.rmse_deg;
    result.rows.push_back(row);
  }
}

}  // namespace

report::PartResult reproduce_colour_pairs(std::uint64_t seed, const std::filesystem::path& folder) {
  report::PartResult result;
  add_views(seed, folder, result);
  add_tracking(seed, result);
  return result;
}

}  // namespace pharos::tools
