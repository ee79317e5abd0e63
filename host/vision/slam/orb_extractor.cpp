// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/orb_extractor.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include "host/vision/slam/quadtree.hpp"

namespace pharos::slam {
namespace {

// A feature's patch, 31 px, turned by any angle, must lie inside; OpenCV's descriptor asks for the same.
constexpr int kBorder_px = 20;
constexpr int kCell_px = 32;  // of FAST
constexpr int kPatchRadius_px = 15;
constexpr int kWindow_px = 5;  // to each side, of gradients
constexpr int kMostSteps = 6;
constexpr double kSmallStep_px = 0.02;
constexpr double kMostMove_px = 0.7;  // farther off it is another corner

int features_of_level(int wanted, int level) {
  const double ratio = 1.0 / kLevelScale;
  return static_cast<int>(
      std::lround(wanted * (1.0 - ratio) / (1.0 - std::pow(ratio, kLevels)) * std::pow(ratio, level)));
}

// Half lengths of the rows of a disc.
const std::array<int, kPatchRadius_px + 1>& disc_rows() {
  static const auto rows = [] {
    std::array<int, kPatchRadius_px + 1> out{};
    for (int v = 0; v <= kPatchRadius_px; ++v) {
      out[static_cast<std::size_t>(v)] =
          static_cast<int>(std::lround(std::sqrt(kPatchRadius_px * kPatchRadius_px - v * v)));
    }
    return out;
  }();
  return rows;
}

// Direction from the corner to the patch's centroid of light (Rosin 1999).
double direction_of(const cv::Mat& image, int u, int v) {
  double m10 = 0.0, m01 = 0.0;
  for (int dv = -kPatchRadius_px; dv <= kPatchRadius_px; ++dv) {
    const int half = disc_rows()[static_cast<std::size_t>(std::abs(dv))];
    const std::uint8_t* row = image.ptr<std::uint8_t>(v + dv) + u;
    int sum = 0, moment = 0;
    for (int du = -half; du <= half; ++du) {
      sum += row[du];
      moment += du * row[du];
    }
    m10 += moment;
    m01 += dv * sum;
  }
  return std::atan2(m01, m10);
}

// Smaller eigenvalue of the gradients' square matrix over 7x7: a smooth measure of a corner.
double corner_strength(const cv::Mat& image, int u, int v) {
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (int dv = -3; dv <= 3; ++dv) {
    const std::uint8_t* row = image.ptr<std::uint8_t>(v + dv) + u;
    const std::uint8_t* above = image.ptr<std::uint8_t>(v + dv - 1) + u;
    const std::uint8_t* below = image.ptr<std::uint8_t>(v + dv + 1) + u;
    for (int du = -3; du <= 3; ++du) {
      const double x = row[du + 1] - row[du - 1], y = below[du] - above[du];
      xx += x * x;
      xy += x * y;
      yy += y * y;
    }
  }
  return 0.5 * (xx + yy - std::sqrt((xx - yy) * (xx - yy) + 4.0 * xy * xy));
}

// Place of a parabola's top over three values, -0.5 to 0.5 from the middle one.
double top_of(double before, double at, double after) {
  const double curvature = before - 2.0 * at + after;
  if (!(curvature < 0.0)) return 0.0;
  return std::clamp(0.5 * (before - after) / curvature, -0.5, 0.5);
}

}  // namespace

struct OrbExtractor::Work {
  OrbSettings settings;
  cv::Ptr<cv::ORB> orb;
  std::array<cv::Mat, kLevels> levels;
  std::vector<PyramidLevel> views;
  std::vector<cv::KeyPoint> found, keypoints;
  std::vector<cv::Point2f> places;
  std::vector<Feature> features;
  cv::Mat descriptors;

  void build(const cv::Mat& image) {
    views.clear();
    for (int level = 0; level < kLevels; ++level) {
      const auto k = static_cast<std::size_t>(level);
      if (level == 0) {
        levels[0] = image;
      } else {
        const double scale = scale_of(level);
        const cv::Size size(std::max(1, cvRound(image.cols / scale)), std::max(1, cvRound(image.rows / scale)));
        cv::resize(levels[k - 1], levels[k], size, 0.0, 0.0, cv::INTER_LINEAR);
      }
      const cv::Mat& mat = levels[k];
      views.push_back({{mat.data, mat.cols, mat.rows, static_cast<std::int32_t>(mat.step[0])}});
    }
  }

  std::vector<Corner> corners_of(int level, ImageView<const std::uint8_t> mask) {
    const cv::Mat& image = levels[static_cast<std::size_t>(level)];
    const double scale_u = static_cast<double>(levels[0].cols) / image.cols;
    const double scale_v = static_cast<double>(levels[0].rows) / image.rows;
    std::vector<Corner> corners;
    const int first = kBorder_px - 3, last_u = image.cols - first, last_v = image.rows - first;
    for (int v = first; v + 6 < last_v; v += kCell_px) {
      for (int u = first; u + 6 < last_u; u += kCell_px) {
        const cv::Rect cell(u, v, std::min(kCell_px + 6, last_u - u), std::min(kCell_px + 6, last_v - v));
        if (cell.width < 7 || cell.height < 7) continue;
        find_in(image(cell));
        for (const cv::KeyPoint& point : found) {
          const auto mu = static_cast<std::int32_t>((static_cast<double>(point.pt.x) + u) * scale_u);
          const auto mv = static_cast<std::int32_t>((static_cast<double>(point.pt.y) + v) * scale_v);
          if (!mask.empty() && (!mask.contains(mu, mv) || mask.at(mu, mv) == 0)) continue;
          corners.push_back({point.pt.x + static_cast<float>(u), point.pt.y + static_cast<float>(v), point.response});
        }
      }
    }
    return corners;
  }

  void find_in(const cv::Mat& cell) {
    found.clear();
    double low = 0.0, high = 0.0;
    cv::minMaxLoc(cell, &low, &high);
    if (high - low <= settings.least_threshold) return;
    cv::FAST(cell, found, settings.threshold, true);
    if (found.empty()) cv::FAST(cell, found, settings.least_threshold, true);
  }

  // Corners between pixels: where the lines across their gradients meet (Foerstner 1987), which stays with the thing
  // itself from whatever side it is seen; the top of a parabola over their strength where that point runs away.
  void place_all(int level, const std::vector<Corner>& corners) {
    const cv::Mat& image = levels[static_cast<std::size_t>(level)];
    places.clear();
    for (const Corner& corner : corners) places.emplace_back(corner.u_px, corner.v_px);
    if (settings.refine && !places.empty()) {
      cv::cornerSubPix(image, places, {kWindow_px, kWindow_px}, {-1, -1},
                       {cv::TermCriteria::COUNT | cv::TermCriteria::EPS, kMostSteps, kSmallStep_px});
    }
    for (std::size_t k = 0; k < corners.size(); ++k) place(level, corners[k], places[k]);
  }

  void place(int level, const Corner& corner, const cv::Point2f& refined) {
    const cv::Mat& image = levels[static_cast<std::size_t>(level)];
    const int u = cvRound(corner.u_px), v = cvRound(corner.v_px);
    double du = static_cast<double>(refined.x) - u, dv = static_cast<double>(refined.y) - v;
    const bool kept = settings.refine && std::hypot(du, dv) <= kMostMove_px;
    if (!kept) {
      const double at = corner_strength(image, u, v);
      du = top_of(corner_strength(image, u - 1, v), at, corner_strength(image, u + 1, v));
      dv = top_of(corner_strength(image, u, v - 1), at, corner_strength(image, u, v + 1));
    }
    // Pixel centres: level pixel x covers the place (x + 0.5) scale - 0.5 of the image.
    const double scale_u = static_cast<double>(levels[0].cols) / image.cols;
    const double scale_v = static_cast<double>(levels[0].rows) / image.rows;
    Feature feature;
    feature.pixel = {(u + du + 0.5) * scale_u - 0.5, (v + dv + 0.5) * scale_v - 0.5};
    feature.level = level;
    feature.angle_rad = direction_of(image, u, v);
    // The descriptor wants the corner's pixel of the level, which OpenCV finds by dividing by the level's scale.
    const auto scale = static_cast<float>(scale_of(level));
    const double degrees = feature.angle_rad * 180.0 / std::numbers::pi;
    keypoints.emplace_back(static_cast<float>(u) * scale, static_cast<float>(v) * scale, 31.0F * scale,
                           static_cast<float>(degrees < 0.0 ? degrees + 360.0 : degrees), corner.response, level,
                           static_cast<int>(features.size()));
    features.push_back(feature);
  }

  void describe() {
    orb->compute(levels[0], keypoints, descriptors);
    std::vector<Feature> described;
    for (std::size_t k = 0; k < keypoints.size(); ++k) {
      Feature feature = features[static_cast<std::size_t>(keypoints[k].class_id)];
      std::memcpy(feature.descriptor.bits.data(), descriptors.ptr(static_cast<int>(k)),
                  sizeof(feature.descriptor.bits));
      described.push_back(feature);
    }
    features = std::move(described);
  }
};

OrbExtractor::OrbExtractor(const OrbSettings& settings) : work_(std::make_unique<Work>()) {
  work_->settings = settings;
  work_->orb = cv::ORB::create(settings.features, static_cast<float>(kLevelScale), kLevels, kBorder_px - 1, 0, 2,
                               cv::ORB::FAST_SCORE, 31, settings.threshold);
}
OrbExtractor::OrbExtractor(OrbExtractor&&) noexcept = default;
OrbExtractor::~OrbExtractor() = default;

const std::vector<PyramidLevel>& OrbExtractor::pyramid() const { return work_->views; }
const std::vector<Feature>& OrbExtractor::features() const { return work_->features; }

const std::vector<Feature>& OrbExtractor::extract(ImageView<const std::uint8_t> image,
                                                  ImageView<const std::uint8_t> mask) {
  Work& work = *work_;
  const cv::Mat mat(image.height_px, image.width_px, CV_8U, const_cast<std::uint8_t*>(image.data),
                    static_cast<std::size_t>(image.stride_px));
  work.build(mat);
  work.features.clear();
  work.keypoints.clear();
  for (int level = 0; level < kLevels; ++level) {
    const cv::Mat& pixels = work.levels[static_cast<std::size_t>(level)];
    if (pixels.cols < 2 * kBorder_px + 1 || pixels.rows < 2 * kBorder_px + 1) break;
    const auto wanted = static_cast<std::size_t>(features_of_level(work.settings.features, level));
    work.place_all(level, spread(work.corners_of(level, mask), static_cast<float>(pixels.cols),
                                 static_cast<float>(pixels.rows), wanted));
  }
  work.describe();
  return work.features;
}

}  // namespace pharos::slam
