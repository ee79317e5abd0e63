// SPDX-License-Identifier: Apache-2.0
// Peers of the low-light enhancement: OpenCV's denoiser, two ways to brighten, and matches of ORB features.
#include <algorithm>
#include <opencv2/calib3d.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/photo.hpp>
#include <vector>

#include "tools/evaluation/bench/low_light_peers.hpp"

namespace {

cv::Mat over(const std::uint8_t* pixels, int width, int height) {
  return {height, width, CV_8U, const_cast<std::uint8_t*>(pixels)};
}

bool non_local_means(const std::uint8_t* in, int width, int height, float strength, std::uint8_t* out) {
  try {
    cv::setNumThreads(1);
    cv::Mat result = over(out, width, height);
    cv::fastNlMeansDenoising(over(in, width, height), result, strength, 7, 21);
    return result.data == out;
  } catch (const cv::Exception&) {
    return false;
  }
}

bool clahe(const std::uint8_t* in, int width, int height, std::uint8_t* out) {
  try {
    cv::Mat result = over(out, width, height);
    cv::createCLAHE(4.0, cv::Size(8, 8))->apply(over(in, width, height), result);
    return result.data == out;
  } catch (const cv::Exception&) {
    return false;
  }
}

bool multi_scale_retinex(const std::uint8_t* in, int width, int height, std::uint8_t* out) {
  try {
    cv::Mat light;
    over(in, width, height).convertTo(light, CV_32F, 1.0, 1.0);
    cv::Mat own, sum = cv::Mat::zeros(height, width, CV_32F);
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
    cv::Mat result = over(out, width, height);
    sum.convertTo(result, CV_8U, 255.0 / (high - low), -255.0 * low / (high - low));
    return result.data == out;
  } catch (const cv::Exception&) {
    return false;
  }
}

int inliers(const std::uint8_t* first, const std::uint8_t* second, int width, int height) {
  try {
    cv::setNumThreads(1);
    cv::setRNGSeed(1);
    const cv::Ptr<cv::ORB> orb = cv::ORB::create(1000);
    std::vector<cv::KeyPoint> points_a, points_b;
    cv::Mat words_a, words_b;
    orb->detectAndCompute(over(first, width, height), cv::noArray(), points_a, words_a);
    orb->detectAndCompute(over(second, width, height), cv::noArray(), points_b, words_b);
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
    std::vector<std::uint8_t> agree;
    if (cv::findFundamentalMat(a, b, cv::FM_RANSAC, 1.0, 0.999, 2000, agree).empty()) return 0;
    return static_cast<int>(std::count(agree.begin(), agree.end(), 1));
  } catch (const cv::Exception&) {
    return 0;
  }
}

constexpr pharos::tools::LowLightPeers kPeers = {non_local_means, clahe, multi_scale_retinex, inliers};

}  // namespace

extern "C" __attribute__((visibility("default"))) const pharos::tools::LowLightPeers* pharos_bench_low_light();
const pharos::tools::LowLightPeers* pharos_bench_low_light() { return &kPeers; }
