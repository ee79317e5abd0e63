// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace pharos {

/// A view of pixels owned by the caller: rows of `width_px` pixels, `stride_px` apart.
///
/// Column u grows to the right, row v downwards; pixel (0, 0) is the first in memory and its CENTRE has the coordinates
/// (0, 0). Copying a view copies no pixel. row() and at() do not check: use contains() for positions from outside.
template <typename Pixel>
struct ImageView {
  Pixel* data = nullptr;
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
  std::int32_t stride_px = 0;

  constexpr ImageView() = default;
  /// Rows without gaps.
  constexpr ImageView(Pixel* pixels, std::int32_t width, std::int32_t height)
      : ImageView(pixels, width, height, width) {}
  constexpr ImageView(Pixel* pixels, std::int32_t width, std::int32_t height, std::int32_t stride)
      : data(pixels), width_px(width), height_px(height), stride_px(stride) {}

  /// A writable view converts to a read-only one.
  constexpr operator ImageView<const Pixel>() const  // NOLINT(google-explicit-constructor)
      requires(!std::is_const_v<Pixel>) {
    return {data, width_px, height_px, stride_px};
  }

  constexpr Pixel* row(std::int32_t v) const { return data + static_cast<std::ptrdiff_t>(v) * stride_px; }
  constexpr Pixel& at(std::int32_t u, std::int32_t v) const { return row(v)[u]; }
  constexpr bool contains(std::int32_t u, std::int32_t v) const {
    return u >= 0 && v >= 0 && u < width_px && v < height_px;
  }
  constexpr bool empty() const { return data == nullptr || width_px <= 0 || height_px <= 0; }
  constexpr std::size_t pixels() const {
    return empty() ? 0 : static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
  }
  template <typename Other>
  constexpr bool same_size(const ImageView<Other>& other) const {
    return width_px == other.width_px && height_px == other.height_px;
  }
};

}  // namespace pharos
