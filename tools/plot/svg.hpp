// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pharos::tools {

/// A point of a picture, in its units from the upper left corner.
struct PlotPoint {
  double x = 0.0;
  double y = 0.0;
};

/// Text with the characters of markup as entities.
std::string escaped_markup(std::string_view words);

/// A picture in SVG, drawn from back to front. Colours are CSS words or "#rrggbb".
class Svg {
 public:
  Svg(double width, double height);

  void line(PlotPoint from, PlotPoint to, std::string_view colour, double width = 1.0, bool dashed = false);
  void polyline(const std::vector<PlotPoint>& points, std::string_view colour, double width = 1.0);
  void polygon(const std::vector<PlotPoint>& points, std::string_view fill, std::string_view colour);
  void circle(PlotPoint centre, double radius, std::string_view fill);
  /// `anchor` is start, middle or end.
  void text(PlotPoint at, std::string_view words, double size = 12.0, std::string_view anchor = "start");

  /// The picture as an element, for a page or a file.
  std::string element() const;
  /// Throws host::InputError when the file cannot be written.
  void write(const std::string& path) const;

 private:
  std::string body_;
  double width_;
  double height_;
};

/// From values to points within a rectangle of a picture; y grows upwards.
struct Axes {
  double left = 0.0, top = 0.0, width = 1.0, height = 1.0;
  double x_low = 0.0, x_high = 1.0, y_low = 0.0, y_high = 1.0;

  PlotPoint at(double x, double y) const;
};

/// A frame with ticks at round values, their numbers, and a title.
void draw_axes(Svg& svg, const Axes& axes, std::string_view title, std::string_view x_label);

}  // namespace pharos::tools
