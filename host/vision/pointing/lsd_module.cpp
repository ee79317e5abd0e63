// SPDX-License-Identifier: Apache-2.0
#include "host/vision/pointing/lsd_module.hpp"

#include <opencv2/imgproc.hpp>
#include <vector>

extern "C" int pharos_opencv_lsd(const std::uint8_t* image, std::int32_t width_px, std::int32_t height_px, double scale,
                                 float* segments, int maximum) {
  try {
    const cv::Mat grey(height_px, width_px, CV_8U, const_cast<std::uint8_t*>(image));
    std::vector<cv::Vec4f> found;
    cv::createLineSegmentDetector(cv::LSD_REFINE_STD, scale)->detect(grey, found);
    int count = 0;
    for (const cv::Vec4f& segment : found) {
      if (count == maximum) break;
      for (int k = 0; k < 4; ++k) segments[4 * count + k] = segment[k];
      ++count;
    }
    return count;
  } catch (const cv::Exception&) {
    return -1;
  }
}
