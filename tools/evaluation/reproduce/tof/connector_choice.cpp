// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/tof/connector_choice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "pharos/base/units.hpp"
#include "tools/evaluation/reproduce/tof/depth_camera_of.hpp"
#include "tools/evaluation/reproduce/tof/eight_bit.hpp"
#include "tools/evaluation/reproduce/tof/paper_tests.hpp"
#include "tools/support/progress.hpp"
#include "tools/tof/paper/paper_chain.hpp"

namespace pharos::tools {
namespace {

constexpr std::size_t kGamma = 5;

enum class Place { kNearest, kOther, kNozzle, kElsewhere };

// The true connector whose face the sight through the pixel meets; else within the nozzle's rim, or foil and ring.
Place place_at(const Vector2& pixel, const DepthCamera& camera, const sim::CameraFromTarget& T_camera_target,
               const sim::Satellite& satellite) {
  const auto ray = undistort(camera.intrinsics, pixel);
  if (!ray) return Place::kElsewhere;
  const Vector3 origin = T_camera_target.R.transpose() * -T_camera_target.t;  // of the camera, in T
  const Vector3 sight = T_camera_target.R.transpose() * Vector3(ray->x(), ray->y(), 1.0);
  for (std::size_t k = 0; k < satellite.connectors.size(); ++k) {
    const sim::Connector& one = satellite.connectors[k];
    const double front_z_m = satellite.face_z_m + one.height_m;
    const Vector3 at = origin + (front_z_m - origin.z()) / sight.z() * sight;
    const double turn = one.direction_deg * kRadPerDeg;
    const Vector2 off = at.head<2>() - one.distance_m * Vector2(std::cos(turn), std::sin(turn));
    const double along = off.x() * std::cos(turn) + off.y() * std::sin(turn);
    const double across = -off.x() * std::sin(turn) + off.y() * std::cos(turn);
    if (std::max(std::abs(along), std::abs(across)) <= 0.5 * one.side_m)
      return k == 0 ? Place::kNearest : Place::kOther;
  }
  const Vector3 in_plane = origin - origin.z() / sight.z() * sight;
  return satellite.nozzle && in_plane.head<2>().norm() < satellite.nozzle->exit_radius_m ? Place::kNozzle
                                                                                         : Place::kElsewhere;
}

// One test at one depth noise.
struct Choice {
  int frames = 0, rings = 0;
  std::map<Place, int> chosen;
  double passed = 0.0;  // regions that pass all rules, over all frames with a ring
  Spread all, control;
};

// Fractions of the simulated depth noise and of the foil's relief.
struct Target {
  const char* name;
  double noise, foil;
};
constexpr std::array<Target, 4> kTargets = {{{"as simulated", 1.0, 1.0},
                                             {"a quarter of the depth noise", 0.25, 1.0},
                                             {"no depth noise", 0.0, 1.0},
                                             {"no depth noise, smooth foil", 0.0, 0.0}}};

class Experiment {
 public:
  Experiment(int frames, std::uint64_t seed, const Target& target, bool printed)
      : frames_(frames),
        simulator_(scenario_of(frames, target), seed),
        camera_(depth_camera_of(simulator_.scenario())) {
    settings_.printed_threshold = printed;
  }

  Choice run(std::size_t test, Progress& progress) {
    Choice choice;
    for (int k = 0; k < frames_; ++k) {
      measure(static_cast<int>(test) * frames_ + k, choice);
      progress.step();
    }
    return choice;
  }

 private:
  static sim::TofScenario scenario_of(int frames, const Target& target) {
    sim::TofScenario scenario = paper_scenario(frames);
    scenario.sensor.sigma_nominal_m *= target.noise;
    scenario.satellite.foil.height_m *= target.foil;
    return scenario;
  }

  Place place_of(const Vector2& pixel, int frame) const {
    return place_at(pixel, camera_, simulator_.truth(frame).T_camera_target, simulator_.scenario().satellite);
  }

  void measure(int frame, Choice& choice) {
    const sim::TofPixels coarse = eight_bit_frame(simulator_.pixels(frame), camera_);
    const paper000::ChainResult chain = paper000::measure(frame_of(coarse).depth, camera_, settings_);
    ++choice.frames;
    if (!chain.stages.ring) return;
    ++choice.rings;
    choice.passed += static_cast<double>(chain.stages.regions[3].size());
    if (chain.pose) choice.all.add(values_of(*chain.pose));
    if (chain.connector_px) ++choice.chosen[place_of(*chain.connector_px, frame)];
    add_control(frame, coarse, chain.stages, choice.control);
  }

  // The largest region on the true nearest connector, instead of the nearest region.
  void add_control(int frame, const sim::TofPixels& coarse, const paper000::ChainStages& stages,
                   Spread& control) const {
    const paper000::Region* largest = nullptr;
    for (const paper000::Region& region : stages.regions[3]) {
      if (place_of(region.middle_px, frame) != Place::kNearest) continue;
      if (largest == nullptr || region.pixels.size() > largest->pixels.size()) largest = &region;
    }
    if (largest == nullptr) return;
    const auto pose = paper000::pose_from(frame_of(coarse).depth, camera_, *stages.ring, largest->middle_px);
    if (pose) control.add(values_of(*pose));
  }

  int frames_;
  sim::TofSimulator simulator_;
  DepthCamera camera_;
  paper000::ChainSettings settings_;
};

void add_rows(std::vector<ComparisonRow>& rows, const std::string& name, const Choice& choice) {
  const auto row = [&](const std::string& what, const char* unit, std::optional<double> value, std::string remark) {
    ComparisonRow one{
        "table 2, experiment: why gamma jumps", name + ": " + what, unit, "", std::nullopt, std::move(remark)};
    one.theirs = value;
    if (!value && one.remark.empty()) one.remark = "no frame";
    rows.push_back(one);
  };
  int chosen = 0;
  for (const auto& [place, count] : choice.chosen) chosen += count;
  const auto percent = [&](Place place) {
    const auto found = choice.chosen.find(place);
    const int count = found == choice.chosen.end() ? 0 : found->second;
    return chosen > 0 ? std::optional(100.0 * count / chosen) : std::nullopt;
  };
  row("the chosen region is on the nearest connector", "%", percent(Place::kNearest),
      std::to_string(chosen) + " of " + std::to_string(choice.frames) + " frames have a region");
  row("it is on the other connector", "%", percent(Place::kOther), "");
  row("it is in the nozzle", "%", percent(Place::kNozzle), "");
  row("it is elsewhere: a patch of foil or ring", "%", percent(Place::kElsewhere), "");
  row("regions of a frame that pass all rules (two connectors)", "",
      choice.rings > 0 ? std::optional(choice.passed / choice.rings) : std::nullopt, "");
  row("sigma of gamma", "deg", choice.all.count() > 1 ? std::optional(choice.all.sigma(kGamma)) : std::nullopt, "");
  row("sigma of gamma, regions on the nearest connector alone", "deg",
      choice.control.count() > 1 ? std::optional(choice.control.sigma(kGamma)) : std::nullopt,
      std::to_string(choice.control.count()) + " of " + std::to_string(choice.frames) +
          " frames have one; chosen by the truth");
}

}  // namespace

std::vector<ComparisonRow> reproduce_connector_choice(int frames, std::uint64_t seed, bool printed_threshold) {
  constexpr std::array<std::size_t, 2> kChosen = {0, 2};
  Progress progress("paper 000's choice of a connector", "frames",
                    kTargets.size() * kChosen.size() * static_cast<std::size_t>(frames));
  std::vector<ComparisonRow> rows;
  for (const Target& target : kTargets) {
    Experiment experiment(frames, seed, target, printed_threshold);
    for (const std::size_t test : kChosen) {
      add_rows(rows, "test " + std::to_string(test + 1) + ", " + target.name, experiment.run(test, progress));
    }
  }
  return rows;
}

}  // namespace pharos::tools
