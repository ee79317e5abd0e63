// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/images/canvas.hpp"

namespace pharos::host {

/// Where an image lies on a canvas that is larger, or made of a smaller copy.
struct CanvasPlace {
  int reduction = 1;      // pixels of the image to one of the canvas' image, on each side
  double shift_px = 0.0;  // columns of the canvas' image left of it
};

/// Lines, ellipses, arrows, dots and words over an image, in its pixels: plain values that are drawn later, at any
/// scale, by any thread. Colours, widths and radii as on a Canvas.
class Drawing {
 public:
  void polyline(std::vector<Place> places, Colour colour, double width = 1.5);
  void ellipse(Place centre, double a_px, double b_px, double theta_rad, Colour colour, double width = 1.5,
               bool dashed = false);
  void arrow(Place from, Place to, Colour colour, double width = 2.0);
  void dot(Place at, Colour colour, double radius = 2.0);
  void cross(Place at, Colour colour);
  void text(Place at, std::string words, Colour colour);

  void draw(Canvas& canvas, CanvasPlace place = {}) const;
  bool empty() const { return marks_.empty(); }

 private:
  enum class Shape : std::uint8_t { kPolyline, kEllipse, kDashedEllipse, kArrow, kDot, kCross, kText };
  struct Mark {
    Shape shape = Shape::kPolyline;
    std::vector<Place> places;
    Colour colour;
    double width = 1.5;                          // of a dot its radius
    double a_px = 0.0, b_px = 0.0, theta = 0.0;  // of an ellipse
    std::string words;
  };

  std::vector<Mark> marks_;
};

}  // namespace pharos::host
