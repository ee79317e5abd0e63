// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/ring2/ring2_writer.hpp"

#include <array>
#include <cstring>
#include <filesystem>

#include "host/cameras/rig_file.hpp"
#include "host/images/grey_image.hpp"
#include "tools/sim/optics/blur.hpp"
#include "tools/sim/optics/image_sensor.hpp"
#include "tools/sim/output_files.hpp"
#include "tools/sim/povray/render_scene.hpp"
#include "tools/sim/ring2/projected_ellipse.hpp"

namespace pharos::sim {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 2> kViews{"left", "right"};
// Least difference of light that is worth more rays: at every edge, not on even surfaces.
constexpr double kAntialias = 0.01;

host::RigCamera rig_camera(const StereoCamera& camera) {
  const Quaternion q = canonical_quaternion(camera.R_rig_camera);
  const Vector3& t = camera.t_rig_camera_m;
  return {optics_as<PinholeCamera>(camera), {q.w(), q.x(), q.y(), q.z()}, {t.x(), t.y(), t.z()}};
}

void write_truth(const std::string& number, const Ring2Pose& pose, const RingAndNozzle& target, host::RowWriter& rows) {
  rows.text(number).number(pose.theta_deg).number(pose.gamma_deg);
  for (int axis = 0; axis < 3; ++axis) rows.number(target.normal[axis]);
  for (int axis = 0; axis < 3; ++axis) rows.number(target.ring_centre_m[axis]);
  rows.number(target.ring_radius_m).number(target.nozzle_radius_m).number(target.distance_m).end_row();
}

void write_ellipses(const std::string& number, const Ring2Scenario& scenario, const RingAndNozzle& target,
                    RandomStream& random, host::RowWriter& rows) {
  for (std::size_t v = 0; v < 2; ++v) {
    for (const char* feature : {"ring", "nozzle"}) {
      const SpaceCircle circle = std::strcmp(feature, "ring") == 0 ? target.ring() : target.nozzle();
      int points = 0;
      const auto ellipse = scenario.edge_sigma_px > 0.0
                               ? noisy_ellipse(scenario.rig[v], circle, scenario.edge_sigma_px, random, points)
                               : projected_ellipse(scenario.rig[v], circle);
      if (!ellipse) continue;  // behind a camera: this view has none
      rows.text(number).text(kViews[v]).text(feature).number(ellipse->cx_px).number(ellipse->cy_px);
      rows.number(ellipse->a_px).number(ellipse->b_px).number(ellipse->theta_rad);
      if (points > 0) {
        rows.number(scenario.edge_sigma_px).integer(points);
      } else {
        rows.none(2);
      }
      rows.end_row();
    }
  }
}

}  // namespace

std::string rig_text_of(const StereoRig& rig) { return host::rig_text({rig_camera(rig[0]), rig_camera(rig[1]), {}}); }

host::GreyImage ring2_image(const Ring2Scenario& scenario, std::size_t pair, std::size_t view, std::uint64_t seed) {
  const StereoCamera& camera = scenario.rig[view];
  const LinearImage light = render_scene(ring2_scene_text(scenario, pair, view), {.width_px = camera.width_px,
                                                                                  .height_px = camera.height_px,
                                                                                  .rays_per_side = 4,
                                                                                  .antialias_threshold = kAntialias});
  RandomStream random(seed, std::string(kViews[view]) + " pixels " + file_number(pair, scenario.poses.size()));
  ImageSensor sensor;
  sensor.bits = scenario.bits;
  return expose(blurred(light, scenario.blur_px), sensor, random);
}

void write_ring2_pairs(const Ring2Scenario& scenario, std::uint64_t seed, const std::string& directory,
                       const std::function<void()>& after_each) {
  const fs::path folder(directory);
  make_output_folder(folder);
  write_output(folder / "rig.toml", rig_text_of(scenario.rig));
  TableFile truth(folder / "truth.csv", {"pair", "theta_deg", "gamma_deg", "nx", "ny", "nz", "cx_m", "cy_m", "cz_m",
                                         "ring_radius_m", "nozzle_radius_m", "distance_m"});
  TableFile ellipses(folder / "ellipses.csv", {"problem", "view", "feature", "cx_px", "cy_px", "a_px", "b_px",
                                               "theta_rad", "sigma_px", "points"});
  for (std::size_t pair = 0; pair < scenario.poses.size(); ++pair) {
    const std::string number = file_number(pair, scenario.poses.size());
    const RingAndNozzle target = scenario.target_at(pair);
    RandomStream random(seed, "edges " + number);
    write_truth(number, scenario.poses[pair], target, truth.rows());
    write_ellipses(number, scenario, target, random, ellipses.rows());
    for (std::size_t v = 0; scenario.render && v < 2; ++v) {
      host::write_grey_png((folder / (number + "_" + kViews[v] + ".png")).string(),
                           ring2_image(scenario, pair, v, seed).view(), scenario.bits);
    }
    truth.rows().flush();
    ellipses.rows().flush();
    after_each();
  }
}

}  // namespace pharos::sim
