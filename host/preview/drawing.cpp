// SPDX-License-Identifier: Apache-2.0
#include "host/preview/drawing.hpp"

#include <utility>

namespace pharos::host {

void Drawing::polyline(std::vector<Place> places, Colour colour, double width) {
  marks_.push_back({Shape::kPolyline, std::move(places), colour, width, 0.0, 0.0, 0.0, {}});
}

void Drawing::ellipse(Place centre, double a_px, double b_px, double theta_rad, Colour colour, double width,
                      bool dashed) {
  const Shape shape = dashed ? Shape::kDashedEllipse : Shape::kEllipse;
  marks_.push_back({shape, {centre}, colour, width, a_px, b_px, theta_rad, {}});
}

void Drawing::arrow(Place from, Place to, Colour colour, double width) {
  marks_.push_back({Shape::kArrow, {from, to}, colour, width, 0.0, 0.0, 0.0, {}});
}

void Drawing::dot(Place at, Colour colour, double radius) {
  marks_.push_back({Shape::kDot, {at}, colour, radius, 0.0, 0.0, 0.0, {}});
}

void Drawing::cross(Place at, Colour colour) {
  marks_.push_back({Shape::kCross, {at}, colour, 0.0, 0.0, 0.0, 0.0, {}});
}

void Drawing::text(Place at, std::string words, Colour colour) {
  marks_.push_back({Shape::kText, {at}, colour, 0.0, 0.0, 0.0, 0.0, std::move(words)});
}

void Drawing::draw(Canvas& canvas, CanvasPlace place) const {
  // Centres of pixels are whole numbers: the first pixel of a copy covers `reduction` of the image.
  const double k = place.reduction;
  const auto placed = [&](Place at) {
    return Place{(at.u_px + 0.5) / k - 0.5 + place.shift_px, (at.v_px + 0.5) / k - 0.5};
  };
  for (const Mark& mark : marks_) {
    std::vector<Place> at;
    at.reserve(mark.places.size());
    for (const Place& one : mark.places) at.push_back(placed(one));
    switch (mark.shape) {
      case Shape::kPolyline:
        canvas.polyline(at, mark.colour, mark.width);
        break;
      case Shape::kEllipse:
      case Shape::kDashedEllipse:
        canvas.ellipse(at[0], mark.a_px / k, mark.b_px / k, mark.theta, mark.colour, mark.width,
                       mark.shape == Shape::kDashedEllipse);
        break;
      case Shape::kArrow:
        canvas.arrow(at[0], at[1], mark.colour, mark.width);
        break;
      case Shape::kDot:
        canvas.dot(at[0], mark.colour, mark.width);
        break;
      case Shape::kCross:
        canvas.cross(at[0], mark.colour);
        break;
      case Shape::kText:
        canvas.text(at[0], mark.words, mark.colour);
        break;
    }
  }
}

}  // namespace pharos::host
