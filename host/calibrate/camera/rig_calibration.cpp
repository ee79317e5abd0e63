// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/camera/rig_calibration.hpp"

#include <algorithm>
#include <cmath>

#include "host/calibrate/camera/board_turns.hpp"
#include "host/calibrate/camera/opencv_boards.hpp"
#include "host/calibrate/camera/set_checks.hpp"
#include "pharos/geometry/rotation.hpp"

namespace pharos::calibrate {
namespace {

constexpr std::array<const char*, 2> kSides{"left", "right"};

using Images = std::vector<ImageOutcome>;

// A pair is used as a whole or not at all: where one image shows no board, the other one gets the status kNoPartner.
void pair_up(std::array<Images, 2>& images) {
  for (std::size_t i = 0; i < images[0].size(); ++i) {
    for (std::size_t side = 0; side < 2; ++side) {
      BoardSearch& own = images[side][i].search;
      const BoardSearch& other = images[1 - side][i].search;
      if (own.status != ImageStatus::kUsed || other.status == ImageStatus::kUsed) continue;
      own.status = ImageStatus::kNoPartner;
      own.detail = std::string("the ") + kSides[1 - side] + " image of the pair was not used";
    }
  }
}

std::size_t used(const Images& images) {
  return static_cast<std::size_t>(std::count_if(images.begin(), images.end(), [](const ImageOutcome& image) {
    return image.search.status == ImageStatus::kUsed;
  }));
}

// A pixel of the equivalent camera without distortion, corrected from the centroid of a dot's image to the image of its
// centre.
std::optional<Vector2> ideal_pixel(const BundleState& state, const BundleData& data, std::size_t camera,
                                   const CameraFromBoard& T, std::size_t view, std::size_t point) {
  const PinholeCamera& lens = state.cameras[camera];
  const Vector2 seen = project_board_point(lens, T, data.board, point).pixel;
  const Vector2 centre = distort(lens, (T * data.board.point_m(point)).hnormalized());
  const auto ray = undistort(lens, data.found[camera][view].points[point].pixel - seen + centre);
  if (!ray) return std::nullopt;
  return Vector2(lens.fx_px * ray->x() + lens.cx_px, lens.fy_px * ray->y() + lens.cy_px);
}

Matrix3 inverse_matrix_of(const PinholeCamera& lens) {
  Matrix3 K;
  K << lens.fx_px, 0.0, lens.cx_px, 0.0, lens.fy_px, lens.cy_px, 0.0, 0.0, 1.0;
  return K.inverse();
}

// The dots' offsets depend on board poses: those of `poses` suffice, they change by far less than a dot.
double epipolar_rms(const BundleState& rig, const std::vector<CameraFromBoard>& poses, const BundleData& data) {
  // x_left^T F x_right = 0.
  const Matrix3 F = inverse_matrix_of(rig.cameras[0]).transpose() * skew(rig.T_left_right.t) * rig.T_left_right.R *
                    inverse_matrix_of(rig.cameras[1]);
  double squares = 0.0, count = 0.0;
  for (std::size_t view = 0; view < poses.size(); ++view) {
    for (std::size_t i = 0; i < data.board.size(); ++i) {
      const auto left = ideal_pixel(rig, data, 0, poses[view], view, i);
      const auto right = ideal_pixel(rig, data, 1, rig.T_left_right.inverse() * poses[view], view, i);
      if (!left || !right) continue;
      const Vector3 line_left = F * right->homogeneous(), line_right = F.transpose() * left->homogeneous();
      const double form = left->homogeneous().dot(line_left);
      squares += form * form * (1.0 / line_left.head<2>().squaredNorm() + 1.0 / line_right.head<2>().squaredNorm());
      count += 2.0;
    }
  }
  return std::sqrt(squares / count);
}

// Both cameras by themselves, or why not.
std::array<CameraCalibration, 2> each_alone(RigCalibration& result, const std::array<GreyView, 2>& first,
                                            const CalibrationChoices& choices) {
  std::array<CameraCalibration, 2> alone;
  for (std::size_t side = 0; side < 2; ++side) {
    alone[side] = calibrate_camera(result.images[side], first[side].width_px, first[side].height_px, choices);
    result.coverage[side] = alone[side].coverage;
    result.images[side] = alone[side].images;
    if (!alone[side].refusal.empty() && result.refusal.empty()) {
      result.refusal = std::string(kSides[side]) + " camera: " + alone[side].refusal;
    }
  }
  return alone;
}

BundleData joint_data(const RigCalibration& result, const CalibrationChoices& choices, const std::vector<int>& turns) {
  BundleData data{choices.board, choices.fix_k3, {{}, {}}};
  for (std::size_t side = 0; side < 2; ++side) {
    for (const ImageOutcome& image : result.images[side]) {
      if (image.search.status != ImageStatus::kUsed) continue;
      const int turn = side == 0 ? 0 : turns[image.view];
      data.found[side].push_back(turned(image.search.board, choices.board, turn));
    }
  }
  return data;
}

void note_fit(RigCalibration& result, const CalibrationChoices& choices) {
  for (std::size_t side = 0; side < 2; ++side) {
    for (ImageOutcome& image : result.images[side]) {
      if (image.search.status == ImageStatus::kUsed) image.rms_px = result.outcome->view_rms_px[side][image.view];
    }
    const auto unobservable = what_is_unobservable(*result.outcome, side, result.coverage[side], choices.fix_k3);
    result.unobservable.insert(result.unobservable.end(), unobservable.begin(), unobservable.end());
  }
}

}  // namespace

RigCalibration calibrate_rig(const std::vector<BoardPicture>& left, const std::vector<BoardPicture>& right,
                             const CalibrationChoices& choices, const StepDone& step_done) {
  RigCalibration result;
  result.images = {find_boards(left, choices, step_done), find_boards(right, choices, step_done)};
  pair_up(result.images);
  result.pairs = used(result.images[0]);
  const std::array<GreyView, 2> first{first_readable(left), first_readable(right)};
  const std::array<CameraCalibration, 2> alone = each_alone(result, first, choices);
  if (!result.refusal.empty()) return result;
  const BundleState &left_state = alone[0].outcome->state, &right_state = alone[1].outcome->state;
  const std::vector<int> turns = matching_turns(left_state.T_camera_board, right_state.T_camera_board, choices.board);
  const BundleData data = joint_data(result, choices, turns);
  const auto opencv =
      opencv_stereo(choices.board, data.found[0], data.found[1], alone[0].camera(), alone[1].camera(), choices.fix_k3);
  BundleState start{{alone[0].camera(), alone[1].camera()}, {}, left_state.T_camera_board};
  start.T_left_right =
      opencv ? opencv->state.T_left_right
             : left_state.T_camera_board[0] * turned(right_state.T_camera_board[0], choices.board, turns[0]).inverse();
  result.outcome = adjust_boards(start, data);
  if (!result.outcome) {
    result.refusal = "the pairs fit no two cameras fixed to each other; check that left and right are in one order";
    return result;
  }
  result.refusal = what_is_degenerate(*result.outcome);
  note_fit(result, choices);
  const BundleState& adjusted = result.outcome->state;
  result.epipolar_rms_px = epipolar_rms(adjusted, adjusted.T_camera_board, data);
  if (opencv) {
    result.opencv_rms_px = opencv->rms_px;
    result.opencv_epipolar_rms_px = epipolar_rms(opencv->state, adjusted.T_camera_board, data);
  }
  return result;
}

}  // namespace pharos::calibrate
