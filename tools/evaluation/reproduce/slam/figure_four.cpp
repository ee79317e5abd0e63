// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/slam/figure_four.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "host/images/grey_image.hpp"
#include "host/vision/enhance/enhancer.hpp"
#include "tools/evaluation/low_light/published_methods.hpp"
#include "tools/evaluation/low_light/rim_halo.hpp"
#include "tools/sim/stereo_tumbling/tumbling_sequence.hpp"
#include "tools/support/progress.hpp"
#include "tools/support/stopwatch.hpp"

namespace pharos::tools {
namespace {

constexpr int kApart = 10;  // frames of 0.5 deg
constexpr double kDark = 0.01, kEven = 0.8;

using Filter = std::function<GreyBytes(const GreyBytes&, int, int)>;

struct Method {
  std::string name, key, printed, source;
  Filter filter;
};

GreyBytes by_lime(const GreyBytes& image, int width_px, int height_px) {
  enhance::EnhanceSettings settings;
  settings.threads = 1;
  enhance::Enhancer enhancer(settings);
  GreyBytes out(image.size());
  enhance::to_integers(enhancer.enhance(ImageView<const std::uint8_t>(image.data(), width_px, height_px)).result.view(),
                       ImageView<std::uint8_t>(out.data(), width_px, height_px));
  return out;
}

// The first is ours.
std::vector<Method> methods() {
  return {{"LIME", "lime", "best", "with BM3D, ours", by_lime},
          {"as it is", "dark", "", "", [](const GreyBytes& image, int, int) { return image; }},
          {"BIMEF", "bimef", "limited effect", "Ying, Li, Gao 2017", bimef},
          {"Dong", "dong", "limited effect", "Dong et al. 2011", dong},
          {"MSRCR", "msrcr", "halo around the satellite", "Jobson, Rahman, Woodell 1997", msrcr},
          {"SRIE", "srie", "limited effect", "Fu et al. 2016", srie}};
}

sim::TumblingScenario lit_scenario(double ambient) {
  sim::TumblingScenario dark;
  dark.turn_deg = 30.0;
  dark.good_light = false;
  dark.ambient = ambient;
  dark.povray = false;
  if (ambient == kEven) dark.stars = 0;
  return dark;
}

GreyBytes upper_bytes(const host::GreyImage& image) {
  GreyBytes bytes;
  for (const std::uint16_t value : image.pixels) bytes.push_back(static_cast<std::uint8_t>(value >> 8U));
  return bytes;
}

struct DarkViews {
  std::array<GreyBytes, 2> dark;
  host::GreyImage even;  // of the first
  int width_px = 0, height_px = 0;
};

DarkViews views_of(std::uint64_t seed) {
  sim::TumblingSequence dark(lit_scenario(kDark), seed), even(lit_scenario(kEven), seed);
  DarkViews views;
  views.dark = {upper_bytes(dark.image(0, 0)), upper_bytes(dark.image(kApart, 0))};
  views.even = even.image(0, 0);
  views.width_px = views.even.width_px;
  views.height_px = views.even.height_px;
  return views;
}

struct Filtered {
  GreyBytes first;
  double matches = 0.0, halo = 0.0, time_s = 0.0;
};

Filtered filtered_by(const Method& method, const DarkViews& views) {
  Filtered outcome;
  GreyBytes second;
  outcome.time_s = 0.5 * processor_seconds_of([&] {
                     outcome.first = method.filter(views.dark[0], views.width_px, views.height_px);
                     second = method.filter(views.dark[1], views.width_px, views.height_px);
                   });
  outcome.matches = inliers_of_orb(outcome.first, second, views.width_px, views.height_px);
  const ImageView<const std::uint8_t> view(outcome.first.data(), views.width_px, views.height_px);
  outcome.halo = 255.0 * std::abs(rim_halo(view, views.even.view()).outside);
  return outcome;
}

void write_picture(const GreyBytes& image, const DarkViews& views, const std::filesystem::path& path) {
  std::vector<std::uint16_t> pixels;
  for (const std::uint8_t value : image) pixels.push_back(static_cast<std::uint16_t>(value * 257));
  host::write_grey_png(path.string(), {pixels.data(), views.width_px, views.height_px}, 8);
}

void add_method_rows(const Method& method, const Filtered& theirs, const Filtered& ours,
                     std::vector<ComparisonRow>& rows) {
  const auto add = [&](const char* what, const char* unit, const std::string& printed, double other, double own,
                       const std::string& remark) {
    ComparisonRow row{"figure 4", method.name + ": " + what, unit, printed, own, remark};
    row.theirs = other;
    rows.push_back(row);
  };
  add("ORB matches of two views", "", method.printed, theirs.matches, ours.matches,
      method.source.empty() ? "ours: LIME with BM3D" : method.source);
  add("glow beside the target, of 255", "", "", theirs.halo, ours.halo, "");
  if (!method.source.empty()) {
    add("processor time of a picture", "s", "", theirs.time_s, ours.time_s, "differs from run to run");
  }
}

}  // namespace

report::PartResult reproduce_figure_four(std::uint64_t seed, const std::filesystem::path& folder) {
  const DarkViews views = views_of(seed);
  const std::vector<Method> all = methods();
  Progress progress("paper 004, figure 4", "methods", all.size());
  report::PartResult result;
  Filtered ours;
  for (const Method& method : all) {
    const Filtered outcome = filtered_by(method, views);
    if (method.key == "lime") {
      ours = outcome;
    } else {
      add_method_rows(method, outcome, ours, result.rows);
    }
    if (!folder.empty()) {
      write_picture(outcome.first, views, folder / (method.key + ".png"));
      result.pictures.push_back({"figure 4", method.name, method.key + ".png"});
    }
    progress.step();
  }
  return result;
}

}  // namespace pharos::tools
