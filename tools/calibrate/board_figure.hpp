// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace pharos::tools {

/// Table 1 of paper 000: calibration from rendered images of one board, beside the true lens of the renderer.
struct BoardFigure {
  struct Parameter {
    std::string name;
    double truth = 0.0, value = 0.0, sigma = 0.0;
    double error_sigmas() const { return (value - truth) / sigma; }
  };
  std::string refusal;  // empty: there is a result
  int images = 0;       // used
  double rms_px = 0.0;
  double opencv_rms_px = 0.0;
  std::vector<Parameter> parameters;  // fx_px … p2; k3 is held at the paper's 0
  double largest_error_sigmas() const;
};

/// Renders `images` poses of the paper's board (12 x 8, 20 mm; dots of 5 mm) through the paper's lens and calibrates.
/// The noise is that of one camera, 280 counts of 65535; retro-reflective dots return 28000 counts of contrast, a
/// printed chessboard a tenth of that. About half a second an image; `tick` is called after each. Throws
/// host::InputError where OpenCV's module is not there.
BoardFigure reproduce_board_calibration(bool dots, int images, std::uint64_t seed, const std::function<void()>& tick);

/// Figure 2 of paper 000: one such image of dots (`prefix`board.png), and its dots as found, joined in their order
/// (`prefix`dots.png). Throws host::InputError where they cannot be written.
void write_board_pictures(const std::string& prefix, std::uint64_t seed);

}  // namespace pharos::tools
