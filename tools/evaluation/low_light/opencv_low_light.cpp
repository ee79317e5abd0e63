// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <opencv2/calib3d.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/photo.hpp>

#include "tools/evaluation/low_light/low_light_peers.hpp"

namespace pharos::tools {
namespace {

cv::Mat over(const GreyBytes& image, int width, int height) {
  return {height, width, CV_8U, const_cast<std::uint8_t*>(image.data())};
}

GreyBytes bytes_of(const cv::Mat& image) { return {image.begin<std::uint8_t>(), image.end<std::uint8_t>()}; }

}  // namespace

GreyBytes non_local_means(const GreyBytes& image, int width_px, int height_px, float strength) {
  cv::setNumThreads(1);
  cv::Mat result;
  cv::fastNlMeansDenoising(over(image, width_px, height_px), result, strength, 7, 21);
  return bytes_of(result);
}

GreyBytes clahe(const GreyBytes& image, int width_px, int height_px) {
  cv::Mat result;
  cv::createCLAHE(4.0, cv::Size(8, 8))->apply(over(image, width_px, height_px), result);
  return bytes_of(result);
}

GreyBytes multi_scale_retinex(const GreyBytes& image, int width_px, int height_px) {
  cv::Mat light;
  over(image, width_px, height_px).convertTo(light, CV_32F, 1.0, 1.0);
  cv::Mat own, sum = cv::Mat::zeros(height_px, width_px, CV_32F);
  cv::log(light, own);
  for (const double sigma : {15.0, 80.0, 250.0}) {
    cv::Mat around;
    cv::GaussianBlur(light, around, cv::Size(), sigma);
    cv::log(around, around);
    sum += (own - around) / 3.0;
  }
  std::vector<float> sorted(sum.begin<float>(), sum.end<float>());
  std::sort(sorted.begin(), sorted.end());
  const double low = static_cast<double>(sorted[sorted.size() / 100]);
  const double high = std::max(low + 1e-6, static_cast<double>(sorted[sorted.size() - 1 - sorted.size() / 100]));
  cv::Mat result;
  sum.convertTo(result, CV_8U, 255.0 / (high - low), -255.0 * low / (high - low));
  return bytes_of(result);
}

int inliers_of_orb(const GreyBytes& first, const GreyBytes& second, int width_px, int height_px) try {
  cv::setNumThreads(1);
  cv::setRNGSeed(1);
  const cv::Ptr<cv::ORB> orb = cv::ORB::create(1000);
  std::vector<cv::KeyPoint> points_a, points_b;
  cv::Mat words_a, words_b;
  orb->detectAndCompute(over(first, width_px, height_px), cv::noArray(), points_a, words_a);
  orb->detectAndCompute(over(second, width_px, height_px), cv::noArray(), points_b, words_b);
  if (words_a.empty() || words_b.empty()) return 0;
  std::vector<cv::DMatch> matches;
  cv::BFMatcher(cv::NORM_HAMMING, true).match(words_a, words_b, matches);
  std::vector<cv::Point2f> a, b;
  for (const cv::DMatch& match : matches) {
    a.push_back(points_a[static_cast<std::size_t>(match.queryIdx)].pt);
    b.push_back(points_b[static_cast<std::size_t>(match.trainIdx)].pt);
  }
  constexpr std::size_t kMin = 8;
  if (a.size() < kMin) return 0;
  GreyBytes agree;
  if (cv::findFundamentalMat(a, b, cv::FM_RANSAC, 1.0, 0.999, 2000, agree).empty()) return 0;
  return static_cast<int>(std::count(agree.begin(), agree.end(), 1));
} catch (const cv::Exception&) {
  return 0;
}

}  // namespace pharos::tools
