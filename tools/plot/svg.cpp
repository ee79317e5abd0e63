// SPDX-License-Identifier: Apache-2.0
#include "tools/plot/svg.hpp"

#include <array>
#include <charconv>
#include <cmath>

#include "host/files/atomic_file.hpp"

namespace pharos::tools {
namespace {

std::string shown(double value, std::chars_format format, int precision) {
  std::array<char, 400> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value, format, precision).ptr};
}
std::string coordinate(double value) { return shown(value, std::chars_format::fixed, 1); }
std::string place(double value) { return "\"" + coordinate(value) + "\""; }

std::string listed(const std::vector<PlotPoint>& points) {
  std::string text;
  for (const PlotPoint& p : points) text += coordinate(p.x) + "," + coordinate(p.y) + " ";
  return text;
}

/// 1, 2 or 5 times a power of ten that divides `span` into about five.
double round_step(double span) {
  const double rough = span / 5.0;
  const double decade = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * decade >= rough) return factor * decade;
  }
  return 10.0 * decade;
}

std::vector<double> multiples_within(double low, double high, double step) {
  std::vector<double> multiples;
  const double first = std::ceil(low / step);
  const auto count = static_cast<int>(std::floor(high / step) - first) + 1;
  for (int i = 0; i < count; ++i) multiples.push_back((first + i) * step);
  return multiples;
}

std::string tick_text(double value, double step) {
  return shown(std::abs(value) < 1e-9 * step ? 0.0 : value, std::chars_format::general, 6);
}

}  // namespace

std::string escaped_markup(std::string_view words) {
  std::string text;
  for (const char c : words) {
    if (c == '<') {
      text += "&lt;";
    } else if (c == '>') {
      text += "&gt;";
    } else if (c == '&') {
      text += "&amp;";
    } else if (c == '"') {
      text += "&quot;";
    } else {
      text += c;
    }
  }
  return text;
}

Svg::Svg(double width, double height) : width_(width), height_(height) {}

void Svg::line(PlotPoint from, PlotPoint to, std::string_view colour, double width, bool dashed) {
  body_ += "<line x1=" + place(from.x) + " y1=" + place(from.y) + " x2=" + place(to.x) + " y2=" + place(to.y) +
           " stroke=\"" + std::string(colour) + "\" stroke-width=" + place(width) +
           (dashed ? " stroke-dasharray=\"5 4\"" : "") + "/>\n";
}

void Svg::polyline(const std::vector<PlotPoint>& points, std::string_view colour, double width) {
  body_ += "<polyline fill=\"none\" stroke=\"" + std::string(colour) + "\" stroke-width=" + place(width) +
           " points=\"" + listed(points) + "\"/>\n";
}

void Svg::polygon(const std::vector<PlotPoint>& points, std::string_view fill, std::string_view colour) {
  body_ += "<polygon fill=\"" + std::string(fill) + "\" stroke=\"" + std::string(colour) + "\" points=\"" +
           listed(points) + "\"/>\n";
}

void Svg::circle(PlotPoint centre, double radius, std::string_view fill) {
  body_ += "<circle cx=" + place(centre.x) + " cy=" + place(centre.y) + " r=" + place(radius) + " fill=\"" +
           std::string(fill) + "\"/>\n";
}

void Svg::text(PlotPoint at, std::string_view words, double size, std::string_view anchor) {
  body_ += "<text x=" + place(at.x) + " y=" + place(at.y) + " font-size=" + place(size) + " text-anchor=\"" +
           std::string(anchor) + "\">" + escaped_markup(words) + "</text>\n";
}

std::string Svg::element() const {
  const auto whole = [](double value) { return "\"" + shown(value, std::chars_format::fixed, 0) + "\""; };
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=" + whole(width_) + " height=" + whole(height_) +
         " font-family=\"sans-serif\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n" + body_ + "</svg>\n";
}

void Svg::write(const std::string& path) const { host::write_file(path, element()); }

PlotPoint Axes::at(double x, double y) const {
  return {left + width * (x - x_low) / (x_high - x_low), top + height * (y_high - y) / (y_high - y_low)};
}

void draw_axes(Svg& svg, const Axes& axes, std::string_view title, std::string_view x_label) {
  const double right = axes.left + axes.width;
  const double bottom = axes.top + axes.height;
  const double x_step = round_step(axes.x_high - axes.x_low);
  for (const double x : multiples_within(axes.x_low, axes.x_high, x_step)) {
    const double at = axes.at(x, axes.y_low).x;
    svg.line({at, axes.top}, {at, bottom}, "#e0e0e0");
    svg.text({at, bottom + 15.0}, tick_text(x, x_step), 11.0, "middle");
  }
  const double y_step = round_step(axes.y_high - axes.y_low);
  for (const double y : multiples_within(axes.y_low, axes.y_high, y_step)) {
    const double at = axes.at(axes.x_low, y).y;
    svg.line({axes.left, at}, {right, at}, "#e0e0e0");
    svg.text({axes.left - 6.0, at + 4.0}, tick_text(y, y_step), 11.0, "end");
  }
  svg.polyline({{axes.left, axes.top}, {right, axes.top}, {right, bottom}, {axes.left, bottom}, {axes.left, axes.top}},
               "#404040");
  svg.text({axes.left, axes.top - 8.0}, title, 13.0);
  svg.text({right, bottom + 32.0}, x_label, 12.0, "end");
}

}  // namespace pharos::tools
