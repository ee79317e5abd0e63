// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/camera/opencv_boards.hpp"

#include <array>

#include "host/calibrate/camera/opencv_module.hpp"
#include "host/support/module_function.hpp"

namespace pharos::calibrate {
namespace {

constexpr std::size_t kIntrinsics = 9;
constexpr std::size_t kPose = 12;

const OpencvModule& opencv() {
  static const OpencvModule& module =
      *reinterpret_cast<OpencvModuleFunction>(host::module_function(kOpencvModuleName, kOpencvModuleFunction))();
  return module;
}

std::vector<double> board_numbers(const Board& board) {
  std::vector<double> numbers;
  for (std::size_t i = 0; i < board.size(); ++i) {
    const Vector3 p = board.point_m(i);
    numbers.insert(numbers.end(), {p.x(), p.y(), p.z()});
  }
  return numbers;
}

std::vector<double> pixel_numbers(const std::vector<FoundBoard>& views) {
  std::vector<double> numbers;
  for (const FoundBoard& view : views) {
    for (const FoundPoint& point : view.points) numbers.insert(numbers.end(), {point.pixel.x(), point.pixel.y()});
  }
  return numbers;
}

PinholeCamera camera_of(const double* intrinsics, std::int32_t width_px, std::int32_t height_px) {
  return {width_px,
          height_px,
          intrinsics[0],
          intrinsics[1],
          intrinsics[2],
          intrinsics[3],
          {intrinsics[4], intrinsics[5], intrinsics[6], intrinsics[7], intrinsics[8]}};
}

void write_optics(const PinholeCamera& camera, double* intrinsics) {
  intrinsics[0] = camera.fx_px;
  intrinsics[1] = camera.fy_px;
  intrinsics[2] = camera.cx_px;
  intrinsics[3] = camera.cy_px;
  for (std::size_t k = 0; k < camera.distortion.size(); ++k) intrinsics[4 + k] = camera.distortion[k];
}

template <class Parent, class Child>
Pose<Parent, Child> pose_of(const double* numbers) {
  const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> R(numbers);
  return {R, Vector3(numbers + 9)};
}

}  // namespace

std::optional<Corners> opencv_corners(ImageView<const std::uint8_t> image, const Board& board) {
  std::vector<double> pixels(2 * board.size());
  Corners corners;
  if (!opencv().find_corners(image.data, image.width_px, image.height_px, board.columns, board.rows, pixels.data(),
                             &corners.edge_px)) {
    return std::nullopt;
  }
  for (std::size_t i = 0; i < board.size(); ++i) corners.pixels.emplace_back(pixels[2 * i], pixels[2 * i + 1]);
  return corners;
}

std::optional<OpencvCalibration> opencv_calibration(const Board& board, const std::vector<FoundBoard>& views,
                                                    std::int32_t width_px, std::int32_t height_px, bool fix_k3) {
  const std::vector<double> points = board_numbers(board), pixels = pixel_numbers(views);
  const ModuleViews input{
      static_cast<int>(views.size()), static_cast<int>(board.size()), points.data(), width_px, height_px, fix_k3};
  std::array<double, kIntrinsics> intrinsics{};
  std::vector<double> poses(kPose * views.size());
  OpencvCalibration result;
  if (!opencv().calibrate(input, pixels.data(), intrinsics.data(), poses.data(), &result.rms_px)) return std::nullopt;
  result.state.cameras = {camera_of(intrinsics.data(), width_px, height_px)};
  for (std::size_t view = 0; view < views.size(); ++view) {
    result.state.T_camera_board.push_back(pose_of<frame::Camera, frame::Board>(poses.data() + kPose * view));
  }
  return result;
}

std::optional<OpencvCalibration> opencv_stereo(const Board& board, const std::vector<FoundBoard>& left,
                                               const std::vector<FoundBoard>& right, const PinholeCamera& left_camera,
                                               const PinholeCamera& right_camera, bool fix_k3) {
  const std::vector<double> points = board_numbers(board), left_pixels = pixel_numbers(left),
                            right_pixels = pixel_numbers(right);
  const ModuleViews input{static_cast<int>(left.size()), static_cast<int>(board.size()), points.data(),
                          left_camera.width_px,          left_camera.height_px,          fix_k3};
  std::array<double, 2 * kIntrinsics> intrinsics{};
  write_optics(left_camera, intrinsics.data());
  write_optics(right_camera, intrinsics.data() + kIntrinsics);
  std::array<double, kPose> pose{};
  OpencvCalibration result;
  if (!opencv().calibrate_stereo(input, left_pixels.data(), right_pixels.data(), intrinsics.data(), pose.data(),
                                 &result.rms_px)) {
    return std::nullopt;
  }
  result.state.cameras = {camera_of(intrinsics.data(), left_camera.width_px, left_camera.height_px),
                          camera_of(intrinsics.data() + kIntrinsics, right_camera.width_px, right_camera.height_px)};
  result.state.T_left_right = pose_of<frame::Camera, frame::Camera>(pose.data()).inverse();
  return result;
}

}  // namespace pharos::calibrate
