// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/orb_extractor.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include "host/vision/slam/level_mask.hpp"
#include "host/vision/slam/quadtree.hpp"

namespace pharos::slam {
namespace {

// A feature's patch, 31 px, rotated by any angle, must be inside; OpenCV's descriptor has the same requirement.
constexpr int kBorder_px = 20;
constexpr int kCell_px = 32;  // of FAST
constexpr int kPatchRadius_px = 15;

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

// Direction from the corner to the patch's intensity centroid (Rosin 1999).
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

}  // namespace

struct OrbExtractor::Work {
  OrbSettings settings;
  cv::Ptr<cv::ORB> orb;
  std::array<cv::Mat, kLevels> levels;
  std::vector<PyramidLevel> views;
  std::vector<cv::KeyPoint> found, keypoints;
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

  // Of the part of a level that begins at (u, v).
  void keep_found(int u, int v, const LevelMask& allowed, std::vector<Corner>& corners) const {
    for (const cv::KeyPoint& point : found) {
      const float at_u = point.pt.x + static_cast<float>(u), at_v = point.pt.y + static_cast<float>(v);
      if (allowed.at(at_u, at_v)) corners.push_back({at_u, at_v, point.response});
    }
  }

  // FAST over the whole level; cells without a corner are searched again with the lower threshold.
  std::vector<Corner> corners_of(int level, ImageView<const std::uint8_t> mask) {
    const cv::Mat& image = levels[static_cast<std::size_t>(level)];
    const LevelMask allowed(mask, levels[0], image);
    const int first = kBorder_px - 3;  // FAST's circle
    const cv::Rect inside(first, first, image.cols - 2 * first, image.rows - 2 * first);
    const int columns = (inside.width - 6 + kCell_px - 1) / kCell_px,
              rows = (inside.height - 6 + kCell_px - 1) / kCell_px;
    std::vector<Corner> corners;
    std::vector<bool> has(static_cast<std::size_t>(std::max(0, columns * rows)), false);
    cv::FAST(image(inside), found, settings.threshold, true);
    keep_found(first, first, allowed, corners);
    for (const Corner& corner : corners) {
      const int column = (static_cast<int>(corner.u_px) - kBorder_px) / kCell_px;
      const int row = (static_cast<int>(corner.v_px) - kBorder_px) / kCell_px;
      const int cell = row * columns + column;
      has[static_cast<std::size_t>(cell)] = true;
    }
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        const int number = row * columns + column;
        if (has[static_cast<std::size_t>(number)]) continue;
        const cv::Rect cell =
            cv::Rect(first + column * kCell_px, first + row * kCell_px, kCell_px + 6, kCell_px + 6) & inside;
        if (!allowed.any(cell)) continue;
        double low = 0.0, high = 0.0;
        cv::minMaxLoc(image(cell), &low, &high);
        if (high - low <= settings.min_threshold) continue;
        cv::FAST(image(cell), found, settings.min_threshold, true);
        keep_found(cell.x, cell.y, allowed, corners);
      }
    }
    return corners;
  }

  void place(int level, const Corner& corner) {
    const cv::Mat& image = levels[static_cast<std::size_t>(level)];
    const int u = cvRound(corner.u_px), v = cvRound(corner.v_px);
    Feature feature;
    feature.pixel = LevelPlaces(views, level).in_image({u, v});
    feature.level = level;
    feature.angle_rad = direction_of(image, u, v);
    const double degrees = feature.angle_rad * 180.0 / std::numbers::pi;
    keypoints.emplace_back(static_cast<float>(u), static_cast<float>(v), 31.0F,
                           static_cast<float>(degrees < 0.0 ? degrees + 360.0 : degrees), corner.response, 0,
                           static_cast<int>(features.size()));
    features.push_back(feature);
  }

  // Descriptors of the level's features; those too near to its border are removed. ORB gets the level as a separate
  // image, so that it need not compute the pyramid again.
  void describe(int level, std::size_t first) {
    orb->compute(levels[static_cast<std::size_t>(level)], keypoints, descriptors);
    std::size_t kept = first;
    for (std::size_t k = 0; k < keypoints.size(); ++k, ++kept) {
      features[kept] = features[static_cast<std::size_t>(keypoints[k].class_id)];
      std::memcpy(features[kept].descriptor.bits.data(), descriptors.ptr(static_cast<int>(k)),
                  sizeof(features[kept].descriptor.bits));
    }
    features.resize(kept);
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
  for (int level = 0; level < kLevels; ++level) {
    const cv::Mat& pixels = work.levels[static_cast<std::size_t>(level)];
    if (pixels.cols < 2 * kBorder_px + 1 || pixels.rows < 2 * kBorder_px + 1) break;
    const auto wanted = static_cast<std::size_t>(features_of_level(work.settings.features, level));
    const std::size_t first = work.features.size();
    work.keypoints.clear();
    for (const Corner& corner : spread(work.corners_of(level, mask), static_cast<float>(pixels.cols),
                                       static_cast<float>(pixels.rows), wanted)) {
      work.place(level, corner);
    }
    if (!work.keypoints.empty()) work.describe(level, first);
  }
  return work.features;
}

}  // namespace pharos::slam
