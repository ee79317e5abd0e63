// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pharos/base/image_view.hpp"

namespace pharos::host {

struct Colour {
  std::uint8_t red = 0, green = 0, blue = 0;
};

/// Colours that differ clearly on grey, also with most kinds of colour blindness (Okabe and Ito).
namespace colours {
inline constexpr Colour kOrange{230, 159, 0}, kSky{86, 180, 233}, kGreen{0, 200, 130}, kYellow{240, 228, 66};
inline constexpr Colour kBlue{60, 130, 220}, kRed{225, 80, 30}, kPink{220, 130, 180}, kWhite{255, 255, 255};
inline constexpr Colour kBlack{0, 0, 0}, kGrey{150, 150, 150};
}  // namespace colours

/// A position in the image: (0, 0) is the centre of its first pixel.
struct Place {
  double u_px = 0.0;
  double v_px = 0.0;
};

/// A colour picture over a grey image, drawn by OpenCV, `zoom` picture pixels to one of the image's. Positions are in
/// image pixels, widths and text sizes in picture pixels. Drawings are clipped to the picture.
class Canvas {
 public:
  /// The image in grey, its 1st to 99.5th percentile stretched over the range, darkened so that drawings are visible.
  Canvas(ImageView<const std::uint16_t> image, int zoom);
  /// A zoom that makes the picture about 1280 pixels wide, 1 to 8.
  static int zoom_for(std::int32_t width_px);

  void line(Place from, Place to, Colour colour, double width = 1.5);
  void polyline(std::span<const Place> places, Colour colour, double width = 1.5);
  /// Semi-axes a and b, theta from +u towards +v; `dashed` omits every second segment.
  void ellipse(Place centre, double a_px, double b_px, double theta_rad, Colour colour, double width = 1.5,
               bool dashed = false);
  void arrow(Place from, Place to, Colour colour, double width = 2.0);
  void dot(Place at, Colour colour, double radius = 2.0);
  void cross(Place at, Colour colour, double half = 5.0);
  /// One pixel of the image, tinted: fraction 1 covers it. For masks of regions.
  void tint(std::int32_t u, std::int32_t v, Colour colour, double fraction);
  /// Printable ASCII in capital letters of 7 times `size`, on a dark background; the position is its upper left corner.
  void text(Place at, std::string_view words, Colour colour, int size = 2);

  std::int32_t width() const { return width_; }
  std::int32_t height() const { return height_; }
  int zoom() const { return zoom_; }
  Colour pixel(std::int32_t x, std::int32_t y) const;
  /// As a JPEG; see encode_jpeg.
  std::vector<std::uint8_t> jpeg(int quality) const;
  /// Throws InputError where the file cannot be written.
  void write_png(const std::string& path) const;

 private:
  struct Spot {
    double x, y;
  };
  Spot spot(Place place) const { return {(place.u_px + 0.5) * zoom_ - 0.5, (place.v_px + 0.5) * zoom_ - 0.5}; }
  template <class Draw>
  void paint(Draw&& draw);
  void cover(std::int32_t left, std::int32_t top, std::int32_t width, std::int32_t height, Colour colour,
             double fraction);
  void stroke(std::span<const Place> places, Colour colour, double width);

  std::int32_t width_ = 0, height_ = 0;
  int zoom_ = 1;
  std::vector<std::uint8_t> rgb_;
};

}  // namespace pharos::host
