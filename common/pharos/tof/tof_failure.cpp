// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/tof_failure.hpp"

#include <array>
#include <cstddef>

namespace pharos::tof {
namespace {

struct Words {
  const char* stage;
  const char* name;
  const char* text;
};

// In the order of TofFailure.
constexpr std::array<Words, 15> kWords = {{
    {"frame", "frame_size", "intensity and depth must be images of one size, at most 640 x 480"},
    {"frame", "camera_size", "the camera file is for another resolution than the images"},
    {"frame", "camera_unusable", "the camera file's focal lengths, depth scale or distortion cannot be used"},
    {"frame", "saturated", "most of the image is saturated: shorten the exposure"},
    {"frame", "no_depth", "hardly a pixel has depth: is the target in range?"},
    {"frame", "stale_rows", "a part of the rows is equal to the frame before: the buffer was not filled"},
    {"ellipses", "no_ellipses", "no ellipse in the intensity image"},
    {"ellipses", "no_nested_pair", "no two ellipses that could be a ring's inner and outer edge"},
    {"ring", "no_ring_plane", "no plane in the depths between two nested ellipses"},
    {"ring", "ring_size", "what was found is no pair of circles of a docking ring's size"},
    {"ring", "no_step", "circles without a step in depth around them: painted?"},
    {"ring", "ring_hidden", "too little of the ring is in sight"},
    {"ring", "ring_edges", "the ring's edges are not circles in its plane"},
    {"ring", "ring_leaves_image", "the ring is partly outside the image"},
    {"ring", "ring_inconsistent", "the ring's edges and its depths tell different planes"},
}};
static_assert(kWords.size() == static_cast<std::size_t>(TofFailure::kRingInconsistent) + 1);

const Words& words(TofFailure failure) { return kWords[static_cast<std::size_t>(failure)]; }

}  // namespace

const char* stage_of(TofFailure failure) { return words(failure).stage; }
const char* name_of(TofFailure failure) { return words(failure).name; }
const char* describe(TofFailure failure) { return words(failure).text; }

}  // namespace pharos::tof
