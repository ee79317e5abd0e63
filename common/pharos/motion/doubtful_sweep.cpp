// SPDX-License-Identifier: Apache-2.0
#include "pharos/motion/doubtful_sweep.hpp"

#include <utility>

#include "pharos/geometry/pose_estimate.hpp"

namespace pharos::motion {
namespace {

// Sweeps of each rotor that tell whether the body was pushed or the sweep was wrong.
constexpr int kTelling = 3;

}  // namespace

void DoubtfulSweep::begin(Hypothesis& best, std::size_t stations) {
  best.reset_cost();
  sweeps_ = kTelling * static_cast<int>(kAxes * stations);
}

bool DoubtfulSweep::judge(std::optional<Hypothesis>& best, std::optional<Hypothesis>& without) {
  --sweeps_;
  const bool was_wrong = without->cost() - best->cost() < -kAmbiguousDeltaChi2;
  if (was_wrong) take_over(best, without);
  if (sweeps_ == 0 || without->cost() - best->cost() > kDecided) {
    without.reset();
    end();
  }
  return was_wrong;
}

void take_over(std::optional<Hypothesis>& best, std::optional<Hypothesis>& alternative) {
  std::swap(best, alternative);
  if (alternative->withheld()) best->confirm_anew();
  best->inherit_disputes(*alternative);
}

}  // namespace pharos::motion
