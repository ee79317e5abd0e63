// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <regex>

#include "host/support/input_error.hpp"
#include "pharos/base/units.hpp"
#include "pharos/pose/precision.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tools/plot_pages/calibration_page.hpp"
#include "tools/plot_pages/curve_panel.hpp"
#include "tools/plot_pages/pose_pages.hpp"
#include "tools/plot_pages/precision_page.hpp"

namespace pharos::tools {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class PlotPages : public ::testing::Test {
 protected:
  std::string written(const HtmlPage& page) const {
    page.write(folder_.path("page.html"));
    std::ifstream file(folder_.path("page.html"));
    return {std::istreambuf_iterator<char>(file), {}};
  }
  test::TemporaryFolder folder_;
};

// Every element that is opened is closed, in order.
void expect_balanced(const std::string& text) {
  std::vector<std::string> open;
  const std::regex tag("<(/?)([a-z0-9]+)[^<>]*?(/?)>");
  for (std::sregex_iterator it(text.begin(), text.end(), tag), end; it != end; ++it) {
    const std::string name = (*it)[2];
    if (name == "meta" || (*it)[3] == "/") continue;
    if ((*it)[1] != "/") {
      open.push_back(name);
      continue;
    }
    ASSERT_FALSE(open.empty()) << name;
    EXPECT_EQ(open.back(), name);
    open.pop_back();
  }
  EXPECT_TRUE(open.empty());
}

// A number that is nowhere finite is a hole in a figure.
void expect_no_nan(const std::string& text) {
  EXPECT_THAT(text, AllOf(Not(HasSubstr("nan")), Not(HasSubstr("\"inf")), Not(HasSubstr(",inf"))));
}

TEST_F(PlotPages, WordsOfAFileAreNoMarkup) {
  HtmlPage page("a <script>");
  page.heading("b & c");
  page.table({"<td>"}, {{"\"quoted\""}});
  const std::string text = written(page);
  EXPECT_THAT(text, AllOf(HasSubstr("a &lt;script&gt;"), HasSubstr("b &amp; c"), HasSubstr("&lt;td&gt;")));
  EXPECT_THAT(text, Not(HasSubstr("<script")));
  expect_balanced(text);
}

TEST_F(PlotPages, CurvesBreakAtGapsAndKeepPeaks) {
  std::vector<BandPoint> points;
  for (int k = 0; k < 9000; ++k)
    points.push_back({0.01 * k + (k >= 4000 ? 100.0 : 0.0), k == 4321 ? 5.0 : 0.0, 0.0, 0.5});
  Svg svg(kPanelWidth, kPanelPitch);
  draw_band_panel(svg, 0.0, "error", points);
  const std::string text = svg.element();
  const auto count = [&text](const std::string& words) {
    std::size_t found = 0;
    for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) ++found;
    return found;
  };
  EXPECT_EQ(count("<polygon"), 2U) << "a band on both sides of the gap";
  EXPECT_EQ(count("<polyline"), 3U) << "two curves and the frame";
  EXPECT_EQ(count(">4<"), 1U) << "the axis, with a tick every 2, reaches the one peak";
}

evaluate::TrajectoryFile<evaluate::EstimatePose> read_poses_table(const std::string& path) {
  return evaluate::read_trajectory<evaluate::EstimatePose>(path, {});
}

// A circle with an error of 1 mm in x, sigmas stated, one refused row and one ambiguous.
std::string pose_table(double shift_m) {
  std::string text = "time_s,qw,qx,qy,qz,tx_m,ty_m,tz_m,sigma_rot_deg,sigma_pos_mm,status\n";
  for (int k = 0; k < 100; ++k) {
    const double angle = 0.05 * k;
    text += std::to_string(0.1 * k) + ",1,0,0,0," + std::to_string(std::cos(angle) + shift_m) + "," +
            std::to_string(std::sin(angle)) + ",2.0,0.1,1.0,ok\n";
  }
  return text + "10.0,,,,,,,,,,refused_too_few\n10.1,1,0,0,0,0,0,2,0.1,1,ambiguous\n";
}

TEST_F(PlotPages, ATrajectoryIsShownWithWhatIsLeftOut) {
  HtmlPage page("poses");
  add_trajectory(page, "poses.csv", read_poses_table(folder_.write("poses.csv", pose_table(0.0))));
  const std::string text = written(page);
  EXPECT_EQ(page.figures(), 3);
  EXPECT_THAT(text, HasSubstr("100 poses shown of 102 rows; not shown: 1 refused, 1 ambiguous."));
  expect_balanced(text);
  expect_no_nan(text);
}

TEST_F(PlotPages, ErrorsAreThoseOfTheTruth) {
  const auto poses = read_poses_table(folder_.write("poses.csv", pose_table(0.001)));
  const auto truth = evaluate::read_trajectory<evaluate::TruthPose>(folder_.write("truth.csv", pose_table(0.0)), {});
  const auto comparison = evaluate::compare(poses, truth, {});
  ASSERT_EQ(comparison.refused, "");
  HtmlPage page("poses");
  add_errors(page, comparison);
  const std::string text = written(page);
  EXPECT_EQ(page.figures(), 2);
  EXPECT_THAT(text, HasSubstr("<td>position, mm</td><td>1</td><td>1</td><td>1</td><td>1</td><td>1</td>"))
      << "RMS, median, 95 %, maximum and NEES of 1 mm against 1 mm";
  expect_balanced(text);
  expect_no_nan(text);
}

Target four_sensors() {
  Target target;
  const double half_m = 0.06;
  for (const auto& [number, place] : {std::pair{0, Vector3(-half_m, -half_m, 0.0)},
                                      {1, Vector3(half_m, -half_m, 0.02)},
                                      {2, Vector3(half_m, half_m, 0.0)},
                                      {3, Vector3(-half_m, half_m, 0.03)}}) {
    SensorPlacement sensor;
    sensor.sensor = static_cast<std::uint8_t>(number);
    sensor.position_m = place;
    target.push_back(sensor);
  }
  return target;
}

TEST_F(PlotPages, PrecisionOverAVolumeIsThatOfEachPose) {
  const Target target = four_sensors();
  PrecisionVolume volume;
  volume.cells = 4;
  volume.sigma_rad = 1e-4;
  HtmlPage page("precision");
  EXPECT_EQ(add_precision(page, target, volume), 2 * 4 * 4);
  double low = 1e9, high = 0.0;  // over the centres of the cells
  for (int plane = 0; plane < 2; ++plane) {
    for (const double across : {-1.5, -0.5, 0.5, 1.5}) {
      for (const double range : {1.625, 2.875, 4.125, 5.375}) {
        LighthouseFromBody pose{Vector3(1.0, -1.0, -1.0).asDiagonal(),
                                plane == 0 ? Vector3(across, 0.0, range) : Vector3(0.0, across, range)};
        const auto precision = pose::precision_of(target, pose, pose::visible_sensors(target, pose), 0.0);
        ASSERT_TRUE(precision);
        const double sigma_mm = precision->pdop_m_per_rad * 1e-4 * kMmPerM;
        low = std::min(low, sigma_mm);
        high = std::max(high, sigma_mm);
      }
    }
  }
  const std::string text = written(page);
  EXPECT_THAT(text, HasSubstr("of one cycle, from " + shown_number(low, 3) + " to " + shown_number(high, 3)));
  expect_balanced(text);
  expect_no_nan(text);
}

TEST_F(PlotPages, WhereNoPoseCanBeMeasuredThereIsNoFigure) {
  Target two = four_sensors();
  while (two.size() > 2) two.pop_back();
  HtmlPage page("precision");
  EXPECT_EQ(add_precision(page, two, {}), 0);
  EXPECT_EQ(page.figures(), 0);
}

constexpr const char* kCalibration =
    "[calibration]\nparameters = ['sensor 0 x_m', 'phase <0>']\ncovariance = [[4e-8, -1e-4], [-1e-4, 1.0]]\n"
    "[[sensor]]\nsensor = 0\nposition_m = [0.0101, 0.0, 0.0]\nnominal_m = [0.01, 0.0, 0.0]\n";

TEST_F(PlotPages, ACalibrationShowsCovarianceCoverageResidualsAndWhatWasRefused) {
  CalibrationFiles files;
  files.calibration = folder_.write("cal.toml", kCalibration);
  files.residuals = folder_.write("residuals.csv",
                                  "station_id,axis,sensor,stills,before_arcsec,after_arcsec\nBEC08E38,x,0,12,40,2\n"
                                  "BEC08E38,x,3,7,30,1\nBEC08E38,y,0,11,20,3\n");
  files.images = folder_.write(
      "images.csv", "image,status,points,rms_px,detail\na.png,used,88,0.05,\nb.png,no_board,0,,nothing found\n");
  HtmlPage page("calibration");
  add_calibration(page, files);
  const std::string text = written(page);
  EXPECT_EQ(page.figures(), 4);
  EXPECT_THAT(text, AllOf(HasSubstr("<td>phase &lt;0&gt;</td><td>1</td>"), HasSubstr("<td>0.0002</td>"),
                          HasSubstr("station BEC08E38, axis x"), HasSubstr("1 no_board, 1 used"),
                          HasSubstr("<td>b.png</td><td>no_board</td><td>nothing found</td>"),
                          HasSubstr("the largest is 0.1 mm on an axis")));
  EXPECT_THAT(text, HasSubstr("#8fafd4")) << "a correlation of -0.5, half way to blue";
  expect_balanced(text);
  expect_no_nan(text);
}

TEST_F(PlotPages, PointsOfABoardAreOverTheImageWithTheirResiduals) {
  CalibrationFiles files;
  files.calibration = folder_.write("camera.toml", "width_px = 100\nheight_px = 50\n" + std::string(kCalibration));
  files.points = folder_.write("points.csv",
                               "image,point,u_px,v_px,du_px,dv_px\na.png,0,49.5,24.5,0.03,0.04\na.png,1,0,0,-0.05,0\n");
  HtmlPage page("calibration");
  add_calibration(page, files);
  const std::string text = written(page);
  EXPECT_THAT(text, AllOf(HasSubstr("2 points (green)"), HasSubstr("root mean square length is 0.05 px"),
                          HasSubstr("40 times as long"), HasSubstr("<circle cx=\"480.0\" cy=\"245.0\"")));
  expect_balanced(text);
  expect_no_nan(text);
}

TEST_F(PlotPages, FilesThatAreNoCalibrationAreRefused) {
  HtmlPage page("calibration");
  for (const char* text : {"a = 1\n", "[calibration]\nparameters = ['a']\ncovariance = []\n",
                           "[calibration]\nparameters = ['a']\ncovariance = [[-1.0]]\n", "no toml"}) {
    const CalibrationFiles files{folder_.write("cal.toml", text), "", "", ""};
    EXPECT_THROW(add_calibration(page, files), host::InputError) << text;
  }
}

}  // namespace
}  // namespace pharos::tools
