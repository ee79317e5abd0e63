// SPDX-License-Identifier: Apache-2.0
// OpenCV's ORB, matcher and RANSAC behind one function: what the paper compares itself with.
#include "tools/evaluation/reproduce/tof/orb/orb_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/features2d.hpp>
#include <vector>

namespace {

using pharos::tools::OrbCamera;
using pharos::tools::OrbFrame;

constexpr int kFeatures = 1000;
constexpr double kFullPicture = 255.0;
constexpr double kBrightestFraction = 0.995;  // of the pixels lie below the picture's white
constexpr float kRatio = 0.8F;                // of the best match's distance to the second best
constexpr int kMinMatches = 8;
// A motion is believed where this many pairs agree with it and the second frame's own depths are where it puts the
// points, in the median: a solution that diverged has neither.
constexpr int kMinAgreeing = 20;
constexpr double kMaxDepthError_m = 0.02;
constexpr int kTrials = 500;
constexpr float kMaxError_px = 2.0F;

struct Features {
  std::vector<cv::KeyPoint> points;
  cv::Mat words;
};

// The grey picture of 8 bits that ORB takes, by the square root, so that the dark foil keeps its texture.
cv::Mat picture(const OrbFrame& frame) {
  const cv::Mat raw(frame.height_px, frame.width_px, CV_16U, const_cast<std::uint16_t*>(frame.intensity));
  cv::Mat grey;
  raw.convertTo(grey, CV_32F);
  cv::Mat sorted;
  cv::sort(grey.reshape(1, 1), sorted, cv::SORT_ASCENDING);
  const float white = sorted.at<float>(static_cast<int>(kBrightestFraction * (sorted.cols - 1)));
  cv::sqrt(cv::min(grey / white, 1.0), grey);
  cv::Mat result;
  grey.convertTo(result, CV_8U, kFullPicture);
  return result;
}

Features features_of(const OrbFrame& frame) {
  Features features;
  cv::ORB::create(kFeatures)->detectAndCompute(picture(frame), cv::noArray(), features.points, features.words);
  return features;
}

// Median distance along z between where the motion puts the points and what the second frame's depths say there.
double depth_error_m(const std::vector<cv::Point3d>& points, const std::vector<cv::Point2d>& to, const cv::Mat& R,
                     const cv::Mat& t, const OrbFrame& second, const OrbCamera& camera) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int counts = second.depth[cvRound(to[i].y) * second.width_px + cvRound(to[i].x)];
    if (counts == 0) continue;
    const cv::Point3d& p = points[i];
    const double z = R.at<double>(2, 0) * p.x + R.at<double>(2, 1) * p.y + R.at<double>(2, 2) * p.z + t.at<double>(2);
    errors.push_back(std::abs(z - counts * camera.depth_scale_m));
  }
  if (errors.size() < static_cast<std::size_t>(kMinMatches)) return std::numeric_limits<double>::infinity();
  const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
  std::nth_element(errors.begin(), middle, errors.end());
  return *middle;
}

bool motion(const OrbFrame& first, const OrbFrame& second, const OrbCamera& camera, cv::Mat& R, cv::Mat& t) {
  const Features one = features_of(first);
  const Features other = features_of(second);
  if (one.words.empty() || other.words.empty()) return false;
  std::vector<std::vector<cv::DMatch>> matches;
  cv::BFMatcher(cv::NORM_HAMMING).knnMatch(one.words, other.words, matches, 2);

  const auto& v = camera.values;
  const cv::Mat K = (cv::Mat_<double>(3, 3) << v[0], 0, v[2], 0, v[1], v[3], 0, 0, 1);
  const cv::Mat distortion = (cv::Mat_<double>(1, 5) << v[4], v[5], v[6], v[7], v[8]);
  std::vector<cv::Point2d> from;
  std::vector<cv::Point2d> to;
  std::vector<double> depth_m;
  for (const std::vector<cv::DMatch>& match : matches) {
    if (match.size() < 2 || match[0].distance > kRatio * match[1].distance) continue;
    const cv::Point2f place = one.points[static_cast<std::size_t>(match[0].queryIdx)].pt;
    const int counts = first.depth[cvRound(place.y) * first.width_px + cvRound(place.x)];
    if (counts == 0) continue;
    from.emplace_back(place);
    to.emplace_back(other.points[static_cast<std::size_t>(match[0].trainIdx)].pt);
    depth_m.push_back(counts * camera.depth_scale_m);
  }
  if (from.size() < kMinMatches) return false;
  std::vector<cv::Point2d> rays;
  cv::undistortPoints(from, rays, K, distortion);
  std::vector<cv::Point3d> points;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    points.emplace_back(rays[i].x * depth_m[i], rays[i].y * depth_m[i], depth_m[i]);
  }
  cv::theRNG().state = 1;  // the same pairs give the same motion
  cv::Mat turn;
  cv::Mat inliers;
  if (!cv::solvePnPRansac(points, to, K, distortion, turn, t, false, kTrials, kMaxError_px, 0.999, inliers)) {
    return false;
  }
  if (inliers.rows < kMinAgreeing) return false;
  std::vector<cv::Point3d> agreeing;
  std::vector<cv::Point2d> seen;
  for (int i = 0; i < inliers.rows; ++i) {
    agreeing.push_back(points[static_cast<std::size_t>(inliers.at<int>(i))]);
    seen.push_back(to[static_cast<std::size_t>(inliers.at<int>(i))]);
  }
  cv::solvePnPRefineLM(agreeing, seen, K, distortion, turn, t);
  cv::Rodrigues(turn, R);
  return depth_error_m(agreeing, seen, R, t, second, camera) < kMaxDepthError_m;
}

}  // namespace

extern "C" bool pharos_orb_motion(const OrbFrame* first, const OrbFrame* second, const OrbCamera* camera,
                                  double* rotation, double* translation_m) {
  try {
    cv::Mat R;
    cv::Mat t;
    if (!motion(*first, *second, *camera, R, t)) return false;
    std::copy_n(R.ptr<double>(), 9, rotation);
    std::copy_n(t.ptr<double>(), 3, translation_m);
    return true;
  } catch (const cv::Exception&) {
    return false;
  }
}
