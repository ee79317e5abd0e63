// SPDX-License-Identifier: Apache-2.0
// Any bytes as a table of ellipses: an InputError, or problems that the solver solves or refuses, with finite numbers
// only.
#include <cmath>
#include <cstdint>
#include <string>

#include "host/support/input_error.hpp"
#include "support/memory_file.hpp"
#include "support/require.hpp"
#include "tools/ring2/ellipse_table.hpp"
#include "tools/sim/ring2/stereo_rig.hpp"

namespace {

using pharos::test::MemoryFile;
using pharos::test::require;
using namespace pharos;

ring2::Rig rig() {
  ring2::Rig rig;
  for (std::size_t v = 0; v < ring2::kViews; ++v) {
    rig.views[v].intrinsics = {1280, 1024, 600.0, 600.0, 639.5, 511.5, {}};
    rig.views[v].T_rig_camera.t.x() = v == 0 ? -0.9 : 0.9;
    const double angle = v == 0 ? 0.35 : -0.35;
    rig.views[v].T_rig_camera.R = rotation_exp({0.0, angle, 0.0});
  }
  return rig;
}

void solve_all(const tools::EllipseTable& table) {
  for (const tools::EllipseProblem& problem : table.problems) {
    const auto estimate = ring2::solve_ring2(rig(), problem.contours);
    if (!estimate) continue;
    require(std::abs(estimate->normal.norm() - 1.0) < 1e-9);
    require(estimate->covariance.allFinite() && std::isfinite(estimate->sigma_normal_rad()));
    require(estimate->ring_centre_m.allFinite() && estimate->nozzle_centre_m.allFinite());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const MemoryFile file(data, size);
  try {
    solve_all(tools::read_ellipse_table(host::ByteSource(file.path())));
  } catch (const host::InputError& error) {
    require(std::string(error.what()).find('\n') == std::string::npos);
  }
  return 0;
}
