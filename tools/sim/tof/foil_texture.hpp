// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "tools/sim/random_stream.hpp"

namespace pharos::sim {

/// Wrinkled foil as a height over a plane: folded waves of many lengths and directions, so that it falls into facets
/// with creases between them. Repeats after kSide_m in both directions.
class FoilTexture {
 public:
  struct Wrinkle {
    double height_m = 0.0;
    double slope_x = 0.0;
    double slope_y = 0.0;
  };

  /// `height_m`: standard deviation of the height.
  FoilTexture(double height_m, RandomStream random);

  /// The same wrinkles `times` as high, moved by (x, y): shares their memory, where drawing new ones takes 30 ms.
  FoilTexture(const FoilTexture& pattern, double times, double x_m, double y_m);

  /// Linear between the grid's points.
  Wrinkle at(double x_m, double y_m) const;

  static constexpr double kSide_m = 2.048;

 private:
  struct Sample {
    float height_m = 0.0F;
    float slope_x = 0.0F;
    float slope_y = 0.0F;
  };
  static constexpr int kCells = 512;  // of 4 mm: finer than a pixel sees from 2.5 m
  std::shared_ptr<const std::vector<Sample>> grid_;
  double times_ = 1.0, x_m_ = 0.0, y_m_ = 0.0;
};

}  // namespace pharos::sim
