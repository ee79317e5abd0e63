// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/camera/camera_calibration.hpp"

#include "host/calibrate/camera/opencv_boards.hpp"
#include "host/calibrate/camera/set_checks.hpp"

namespace pharos::calibrate {
namespace {

std::vector<FoundBoard> take_views(std::vector<ImageOutcome>& images) {
  std::vector<FoundBoard> views;
  for (ImageOutcome& image : images) {
    if (image.search.status != ImageStatus::kUsed) continue;
    image.view = views.size();
    views.push_back(image.search.board);
  }
  return views;
}

std::string too_few(std::size_t views, std::size_t images) {
  return std::to_string(views) + " of " + std::to_string(images) + " images show the whole board; at least " +
         std::to_string(kMinViews) + " are needed";
}

}  // namespace

std::vector<ImageOutcome> find_boards(const std::vector<BoardPicture>& pictures, const CalibrationChoices& choices,
                                      const StepDone& step_done) {
  const GreyView first = first_readable(pictures);
  std::vector<ImageOutcome> images;
  for (const BoardPicture& picture : pictures) {
    ImageOutcome outcome;
    outcome.name = picture.name;
    if (!picture.error.empty()) {
      outcome.search.status = ImageStatus::kUnreadable;
      outcome.search.detail = picture.error;
    } else if (picture.image.same_size(first)) {
      outcome.search = find_board(picture.image, choices.board, choices.dot_threshold);
    } else {
      outcome.search.status = ImageStatus::kOtherSize;
      outcome.search.detail = std::to_string(picture.image.width_px) + " x " + std::to_string(picture.image.height_px) +
                              " px, the first image has " + std::to_string(first.width_px) + " x " +
                              std::to_string(first.height_px);
    }
    images.push_back(std::move(outcome));
    if (step_done) step_done();
  }
  return images;
}

CameraCalibration calibrate_camera(std::vector<ImageOutcome> images, int width_px, int height_px,
                                   const CalibrationChoices& choices) {
  CameraCalibration result;
  result.images = std::move(images);
  BundleData data{choices.board, choices.fix_k3, {take_views(result.images)}};
  const std::vector<FoundBoard>& views = data.found.front();
  result.coverage = coverage_of(views, width_px, height_px);
  if (views.size() < static_cast<std::size_t>(kMinViews)) {
    result.refusal = too_few(views.size(), result.images.size());
    return result;
  }
  const auto start = opencv_calibration(choices.board, views, width_px, height_px, choices.fix_k3);
  std::optional<BundleOutcome> outcome;
  if (start) outcome = adjust_boards(start->state, data);
  if (!outcome) {
    result.refusal = "the images fit no camera; check the board's columns, rows and pitch, and tilt it between images";
    return result;
  }
  result.refusal = what_is_degenerate(*outcome);
  result.opencv_rms_px = start->rms_px;
  result.unobservable = what_is_unobservable(*outcome, 0, result.coverage, choices.fix_k3);
  for (ImageOutcome& image : result.images) {
    if (image.search.status == ImageStatus::kUsed) image.rms_px = outcome->view_rms_px.front()[image.view];
  }
  result.outcome = std::move(outcome);
  return result;
}

CameraCalibration calibrate_camera(const std::vector<BoardPicture>& pictures, const CalibrationChoices& choices,
                                   const StepDone& step_done) {
  const GreyView first = first_readable(pictures);
  return calibrate_camera(find_boards(pictures, choices, step_done), first.width_px, first.height_px, choices);
}

}  // namespace pharos::calibrate
