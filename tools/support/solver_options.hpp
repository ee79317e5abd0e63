// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "pharos/pose/solve.hpp"

namespace CLI {
class App;
}

namespace pharos::tools {

/// Options for the noise of bearings.
struct NoiseOptions {
  double sigma_arcsec = 8.8;
  double rho = 0.0;

  double sigma_rad() const { return sigma_arcsec * kRadPerArcsec; }
};

/// Options of the solver.
struct SolverOptions {
  NoiseOptions noise;
  std::string start = "auto";
  std::string residual = "angle";

  pose::SolveOptions solve() const;
};

/// --sigma-arcsec, --rho
void add_noise_options(CLI::App& command, NoiseOptions& options);
/// these and --start, --residual
void add_solver_options(CLI::App& command, SolverOptions& options);

}  // namespace pharos::tools
