// SPDX-License-Identifier: Apache-2.0
// Bodies at which campaigns found an integrity failure, by their seeds.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <initializer_list>

#include "tools/evaluation/reproduce/integrity/trial.hpp"

namespace pharos::tools {
namespace {

using Trial = std::function<IntegrityTrial(std::uint64_t seed)> IntegrityKind::*;

void expect_no_failure(const std::string& name, std::initializer_list<std::uint64_t> seeds,
                       Trial trial_of = &IntegrityKind::trial) {
  const std::vector<IntegrityKind>& kinds = integrity_kinds();
  const auto kind = std::find_if(kinds.begin(), kinds.end(), [&](const IntegrityKind& k) { return k.name == name; });
  ASSERT_NE(kind, kinds.end());
  for (const std::uint64_t seed : seeds) {
    const IntegrityTrial trial = ((*kind).*trial_of)(seed);
    for (const Deviation& d : trial.deviations) {
      EXPECT_FALSE(trial.failed()) << "seed " << seed << ": " << d.quantity << " " << d.error << ", sigma " << d.sigma;
    }
  }
}

// A boom, a rail and bodies' outlines, taken for the panel; a panel's edge and a body's in line; panels seen along
// their axis, whose width was taken for it, across the body as a wing; a body's outline that a panel interrupts;
// a body's face beside a panel that the border cuts, and beside one of which only one side is measured; a boom with
// an edge in line; a width taken for the length where the axis is known to some degrees; two faces of a body with the
// ends of one, and the pieces of a body's sides beside its wings; booms of a hardly known axis; bodies with a face in
// the dark behind one side; a side of a panel that the border cuts, with a boom;
// a body of which dark foil interrupts the outline, as a wing, and as a panel with an edge in line; two faces of alike
// light with one end; a piece of an end for a side, seen along the axis; a wing with a bright line beside two of its
// sides; the edge of another face that cuts a face's corner off; a body's edge in line with a side; short edges of
// a body that face a panel's side; the rest of a body's side behind a panel; a flat
// corner of two faces; the yokes of a wing; a face before wings, whose sides go on beyond them; two pieces of one end
// for sides; pieces of a wing's side of unequal scatter.
TEST(IntegritySeeds, Line) {
  expect_no_failure("line", {62,     108,    220,    244,    1039,   1251,   1430,   1446,   3378,   60259,  60665,
                             60891,  61369,  200023, 200314, 300074, 300237, 400097, 430006, 432141, 432378, 450045,
                             450232, 450280, 450365, 460048, 460270, 462197, 463120, 464076, 464150, 464207, 464491,
                             480001, 481750, 494127, 495456, 495509, 495790, 496048, 701293, 701916, 702981, 703865});
}

// Grey values that are a power of the light: a dark face behind half of a side moves that half otherwise; converging
// sides meet elsewhere; a short edge of a body that faces a panel's side; a side that goes on with a bend, as a third
// edge.
TEST(IntegritySeeds, LineByAToneCurve) {
  expect_no_failure("line", {495059, 495276, 495456, 495795}, &IntegrityKind::toned);
}

// Polygons that end along a contour, one of nearly its step, what one leaves of a dot, and two between them; an edge of
// a polygon between two gaps, for a part of the contour.
TEST(IntegritySeeds, Ellipses) {
  expect_no_failure("ellipses",
                    {60435, 61811, 62051, 62190, 63065, 80122, 80881, 80934, 93094, 212802, 490468, 492524});
}

// Bright shapes grow by a part of the blur: dots, rings and cut contours.
TEST(IntegritySeeds, EllipsesByAToneCurve) {
  expect_no_failure("ellipses", {499001, 499004, 499005, 499006, 499007, 499011, 499012, 499013, 499015, 499016},
                    &IntegrityKind::toned);
}

// A look-alike for a dark connector, another for a hidden one, a wall taken for a connector's edge, and a thruster or
// a cover for a connector behind a boom; a small ring, of which depth alone tells the size, for a described connector,
// and one of three thrusters; a connector whose plate has lost its depth, dark ones in bright foil, and one that
// was not looked at because of three thrusters; a cover for one that depth hardly shows; a thruster for a described
// one.
TEST(IntegritySeeds, Tof) {
  expect_no_failure("tof", {1191, 1411, 2328, 30319, 31951, 40061, 123135, 202518, 460234, 701727, 702679, 702771,
                            702856, 711665, 712128, 710494});
}

// The foot of a ring, the edge of a round body, whose nozzle the ring was taken for, a small ring beside it, a groove;
// three bodies with a second ring; a groove and a band behind rings that a boom crosses.
TEST(IntegritySeeds, Ring2) {
  expect_no_failure("ring2",
                    {10014, 10185, 10228, 10330, 10454, 20095, 20244, 20370, 200026, 200054, 200314, 483006, 485148});
}

}  // namespace
}  // namespace pharos::tools
