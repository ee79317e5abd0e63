// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/stereo_frontend.hpp"

#include <algorithm>
#include <array>
#include <future>
#include <opencv2/imgproc.hpp>

#include "host/vision/slam/exposure_ratio.hpp"
#include "host/vision/slam/scene_choice.hpp"

namespace pharos::slam {
namespace {

// A feature needs differences of this many grey values (OrbSettings::min_threshold): an image with a smaller difference
// of its 99.9th and 0.1st percentiles has none.
constexpr int kMinContrast = 8;
constexpr std::uint8_t kBright = 250;

constexpr double kFeatures = 1000.0, kOfPixels = 640.0 * 480.0;

int features_of(const SlamSettings& settings, const StereoCamera& camera) {
  if (settings.features > 0) return settings.features;
  const double pixels = static_cast<double>(camera.width_px) * camera.height_px;
  return static_cast<int>(kFeatures * std::max(1.0, pixels / kOfPixels));
}

cv::Mat mat_of(ImageView<const std::uint8_t> image) {
  return {image.height_px, image.width_px, CV_8U, const_cast<std::uint8_t*>(image.data),
          static_cast<std::size_t>(image.stride_px)};
}

ImageView<const std::uint8_t> view_of(const cv::Mat& mat) {
  return {mat.data, mat.cols, mat.rows, static_cast<std::int32_t>(mat.step[0])};
}

struct Levels {
  int low = 0, high = 0;
};

Levels levels_of(const cv::Mat& image) {
  std::array<int, 256> histogram{};
  for (int v = 0; v < image.rows; ++v) {
    const std::uint8_t* row = image.ptr<std::uint8_t>(v);
    for (int u = 0; u < image.cols; ++u) ++histogram[row[u]];
  }
  const int tail = static_cast<int>(image.total() / 1000);
  Levels levels{0, 255};
  for (int sum = histogram[0]; sum <= tail && levels.low < 255; sum += histogram[static_cast<std::size_t>(levels.low)])
    ++levels.low;
  for (int sum = histogram[255]; sum <= tail && levels.high > 0;
       sum += histogram[static_cast<std::size_t>(levels.high)])
    --levels.high;
  return levels;
}

}  // namespace

struct StereoFrontend::Work {
  struct Side {
    cv::Mat map_u, map_v, image, raw_before;
    OrbExtractor extractor;
    explicit Side(const OrbSettings& settings) : extractor(settings) {}
  };
  Side left, right;
  Foreground foreground;
  StaticFeatureFilter still;
  ExposureRatio exposure;
  ImageView<const std::uint8_t> mask;
  explicit Work(const OrbSettings& settings) : left(settings), right(settings) {}

  static void prepare(Side& side, const RectifyMap& map, const StereoCamera& camera) {
    const auto plane = [&](const std::vector<float>& values) {
      return cv::Mat(camera.height_px, camera.width_px, CV_32F, const_cast<float*>(values.data()));
    };
    cv::convertMaps(plane(map.u), plane(map.v), side.map_u, side.map_v, CV_16SC2);
  }
  static void rectify(Side& side, const cv::Mat& raw) {
    if (side.map_u.empty()) {
      raw.copyTo(side.image);
    } else {
      cv::remap(raw, side.image, side.map_u, side.map_v, cv::INTER_LINEAR);
    }
  }
  // Whether the image equals the one before.
  static bool remember(Side& side, const cv::Mat& raw) {
    const bool same = side.raw_before.size() == raw.size() && cv::norm(raw, side.raw_before, cv::NORM_INF) == 0.0;
    raw.copyTo(side.raw_before);
    return same;
  }
};

StereoFrontend::StereoFrontend(Rectification rectification, const SlamSettings& settings)
    : rectification_(std::move(rectification)), settings_(settings) {
  cv::setNumThreads(1);
  OrbSettings orb;
  orb.features = features_of(settings, rectification_.camera);
  work_ = std::make_unique<Work>(orb);
  if (!rectification_.needed()) return;
  Work::prepare(work_->left, rectification_.maps[0], rectification_.camera);
  Work::prepare(work_->right, rectification_.maps[1], rectification_.camera);
  rectification_.maps = {};
}

StereoFrontend::~StereoFrontend() = default;

ImageView<const std::uint8_t> StereoFrontend::image() const { return view_of(work_->left.image); }
ImageView<const std::uint8_t> StereoFrontend::mask() const { return work_->mask; }
const std::vector<PyramidLevel>& StereoFrontend::pyramid() const { return work_->left.extractor.pyramid(); }

StereoFrontend::Result StereoFrontend::push(ImageView<const std::uint8_t> left, ImageView<const std::uint8_t> right,
                                            bool check_order) {
  Work& work = *work_;
  Result result;
  const bool left_same = Work::remember(work.left, mat_of(left)),
             right_same = Work::remember(work.right, mat_of(right));
  result.repeated = left_same && right_same;
  const Levels levels = levels_of(mat_of(left));
  result.saturated = levels.low >= kBright;
  result.dark = !result.saturated && levels.high - levels.low < kMinContrast;
  if (settings_.scene == Scene::kAuto) seen_scene_ = scene_of(left);
  const double exposure = work.exposure.of(left, right);
  const auto do_right = [&] {
    Work::rectify(work.right, mat_of(right));
    if (exposure != 1.0) work.right.image.convertTo(work.right.image, CV_8U, exposure);
    work.right.extractor.extract(view_of(work.right.image), {});
  };
  std::future<void> other;
  if (settings_.threads) other = std::async(std::launch::async, do_right);
  Work::rectify(work.left, mat_of(left));
  work.mask = {};
  if (scene() == Scene::kTarget) work.mask = work.foreground.of(view_of(work.left.image));
  result.features = work.left.extractor.extract(view_of(work.left.image), work.mask);
  if (other.valid()) {
    other.get();
  } else {
    do_right();
  }
  const std::vector<Feature>& right_features = work.right.extractor.features();
  result.stats =
      match_stereo(result.features, right_features, work.left.extractor.pyramid(), work.right.extractor.pyramid(),
                   rectification_.camera, 3.0 * rectification_.camera.baseline_m, check_order);
  work.exposure.learn(exposure, result.features, work.left.extractor.pyramid(), work.right.extractor.pyramid());
  if (scene() == Scene::kTarget) work.still.remove_static(result.features);
  return result;
}

}  // namespace pharos::slam
