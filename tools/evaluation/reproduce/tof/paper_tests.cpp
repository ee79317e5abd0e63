// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/tof/paper_tests.hpp"

#include "pharos/base/units.hpp"

namespace pharos::tools {

sim::TofScenario paper_scenario(int frames) {
  constexpr std::array<Values, kPaperTests> kPoses = {{{-24.9, -17.7, 4161.0, 2.2, -1.1, -40.0},
                                                       {-24.9, -17.7, 4161.0, 2.2, -1.1, -50.0},
                                                       {-24.9, -17.7, 3161.0, 2.2, -1.1, -50.0},
                                                       {-24.9, -17.7, 3161.0, -2.8, -1.1, -50.0}}};
  sim::TofScenario scenario;
  for (const Values& v : kPoses) {
    sim::CameraFromTarget pose;
    pose.t = Vector3(v[0], v[1], v[2]) / kMmPerM;
    pose.R = sim::attitude_of({v[3], v[4], v[5]});
    scenario.poses.insert(scenario.poses.end(), static_cast<std::size_t>(frames), pose);
  }
  return scenario;
}

Values values_of(const tof::CameraFromTarget& pose) {
  const sim::PaperAngles angles = sim::angles_of(pose.R);
  return {pose.t.x() * kMmPerM, pose.t.y() * kMmPerM, pose.t.z() * kMmPerM,
          angles.alpha_deg,     angles.beta_deg,      angles.gamma_deg};
}

}  // namespace pharos::tools
