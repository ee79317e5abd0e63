// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>

#include "pharos/motion/hypothesis.hpp"

namespace pharos::motion {

/// A steady body was pushed, or a sweep was wrong: the hypothesis that took it and one without it run beside each
/// other, and the likelihood of the next sweeps decides. A pushed body moves on as the sweep said; after a wrong one
/// the next sweeps agree with the motion before it. The hypothesis that took it needs the benefit of the doubt: its
/// wide covariance holds both.
class DoubtfulSweep {
 public:
  /// `best`, which takes the sweeps of so many stations, has just taken it.
  void begin(Hypothesis& best, std::size_t stations);
  void end() { sweeps_ = 0; }
  bool open() const { return sweeps_ > 0; }
  /// Both have taken one more sweep. True where `without` took the place of `best`; where it is decided, `without` is
  /// empty.
  bool judge(std::optional<Hypothesis>& best, std::optional<Hypothesis>& without);

 private:
  int sweeps_ = 0;  // by which it is still judged
};

/// The two change places; the one that takes over is confirmed anew where the other withheld what it took, and what
/// spoke against the target in the other's sweeps does so still.
void take_over(std::optional<Hypothesis>& best, std::optional<Hypothesis>& alternative);

/// Difference of chi-squared from which the worse of two hypotheses is dropped: e^9 to one.
inline constexpr double kDecided = 18.0;

}  // namespace pharos::motion
