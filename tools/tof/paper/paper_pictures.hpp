// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tools/tof/paper/paper_chain.hpp"

namespace pharos::tools::paper000 {

struct StagePicture {
  std::string figure;   ///< "figure 5"
  std::string caption;  ///< what is seen
  std::string path;
};

/// Figures 5 (ring) and 6 (connector) of the paper, a PNG a step, named after the printed letters:
/// `prefix`5a_grey.png to `prefix`5f_ring.png, `prefix`6b_above.png to `prefix`6f_filling.png (6a is 5a; none where
/// there is no ring). Throws host::InputError where they cannot be written.
std::vector<StagePicture> write_stage_pictures(const std::string& prefix, const ChainStages& stages);

/// The amplitude of the same frame, `prefix`5_amplitude.png: the chain does not use it.
void write_amplitude_picture(const std::string& prefix, ImageView<const std::uint16_t> intensity);

}  // namespace pharos::tools::paper000
