// SPDX-License-Identifier: Apache-2.0
// OpenCV's ellipse detector for the benchmark, with default parameters, one thread.
#include <algorithm>
#include <opencv2/ximgproc/edge_drawing.hpp>

#include "tools/evaluation/bench/edge_drawing.hpp"
#include "tools/support/stopwatch.hpp"

extern "C" int pharos_bench_edge_drawing(const std::uint8_t* pixels, int width_px, int height_px, double* ellipses,
                                         int maximum, double* seconds) {
  try {
    cv::setNumThreads(1);
    static const cv::Ptr<cv::ximgproc::EdgeDrawing> detector = cv::ximgproc::createEdgeDrawing();
    // OpenCV takes read-only data by a pointer to non-const.
    const cv::Mat image(height_px, width_px, CV_8U, const_cast<std::uint8_t*>(pixels));
    cv::Mat found;
    *seconds = pharos::tools::processor_seconds_of([&] {
      detector->detectEdges(image);
      detector->detectEllipses(found);
    });
    const int count = std::min(maximum, static_cast<int>(found.total()));
    for (int k = 0; k < count; ++k) {
      // Circles have a radius and no axes, ellipses axes and no radius; degrees.
      const auto& e = found.at<cv::Vec6d>(k);
      const double one = e[2] + e[3], other = e[2] + e[4];
      const double theta = e[5] * CV_PI / 180.0 + (one < other ? CV_PI / 2.0 : 0.0);
      const double row[] = {e[0], e[1], std::max(one, other), std::min(one, other), theta};
      std::copy(std::begin(row), std::end(row), ellipses + 5 * k);
    }
    return count;
  } catch (const cv::Exception&) {
    return -1;
  }
}
