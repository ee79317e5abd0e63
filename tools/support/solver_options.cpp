// SPDX-License-Identifier: Apache-2.0
#include "tools/support/solver_options.hpp"

#include <CLI/CLI.hpp>
#include <map>

#include "tools/support/number_option.hpp"

namespace pharos::tools {
namespace {

const std::map<std::string, pose::Start>& starts() {
  static const std::map<std::string, pose::Start> words = {{"auto", pose::Start::kAuto},
                                                           {"p3p", pose::Start::kP3p},
                                                           {"rpnp", pose::Start::kRpnp},
                                                           {"dlt", pose::Start::kDlt},
                                                           {"homography", pose::Start::kHomography}};
  return words;
}

// Limits: a bearing noise of a degree is of no use; zero would divide by zero.
constexpr double kMinSigma_arcsec = 1e-6;
constexpr double kMaxSigma_arcsec = 3600.0;
constexpr double kMaxRho = 0.999999;

}  // namespace

pose::SolveOptions SolverOptions::solve() const {
  pose::SolveOptions options;
  options.sigma_rad = noise.sigma_rad();
  options.rho = noise.rho;
  options.start = starts().at(start);
  options.residual = residual == "tangent" ? pose::Residual::kTangent : pose::Residual::kAngle;
  return options;
}

void add_noise_options(CLI::App& command, NoiseOptions& options) {
  command.add_option("--sigma-arcsec", options.sigma_arcsec, "Noise of one bearing that sigmas and gates assume")
      ->check(number_from(kMinSigma_arcsec, kMaxSigma_arcsec))
      ->capture_default_str();
  command.add_option("--rho", options.rho, "Correlation between sensors of one rotor, equation (19)")
      ->check(number_from(0.0, kMaxRho))
      ->capture_default_str();
}

void add_solver_options(CLI::App& command, SolverOptions& options) {
  add_noise_options(command, options.noise);
  command.add_option("--start", options.start, "Start value: auto, p3p, rpnp, dlt (n >= 6) or homography (coplanar)")
      ->check(CLI::IsMember({"auto", "p3p", "rpnp", "dlt", "homography"}))
      ->capture_default_str();
  command.add_option("--residual", options.residual, "angle, or tangent: the paper's residual (6) as printed")
      ->check(CLI::IsMember({"angle", "tangent"}))
      ->capture_default_str();
}

}  // namespace pharos::tools
