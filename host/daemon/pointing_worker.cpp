// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/pointing_worker.hpp"

#include <memory>

#include "host/images/grey_image.hpp"
#include "host/preview/pointing_drawing.hpp"
#include "host/support/flag_text.hpp"
#include "host/support/input_error.hpp"
#include "host/vision/pointing/measure_panel.hpp"

namespace pharos::host {
namespace {

constexpr std::size_t kMaxWaitingImages = 512;  // a burst of many images at once; beyond this the oldest is dropped

ImageResult measured(const ImageJob& job, const PinholeCamera& camera) {
  ImageResult result;
  result.observation = job.observation;
  try {
    const GreyImage image = read_grey_image(job.file.string());
    if (image.from_colour) result.remark = colour_remark(job.file.string());
    const auto panel = pointing::measure_panel(image.view(), camera);
    if (job.with_picture) {
      result.pictures.push_back(annotated_image(image.view(), panel ? pointing_drawing(*panel, camera) : Drawing()));
    }
    if (!panel) {
      result.refusal = pointing::name_of(panel.error());
      result.advice = job.file.string() + ": " + pointing::advice_of(panel.error());
      return result;
    }
    const pointing::PointingResult answer =
        pointing::answer_of(*panel, job.observation.sight, pointing::tone_of_bits(image.bits));
    if (answer.second_axis) {
      result.refusal = "panel_ambiguous";
      result.advice = job.file.string() + ": two pairs of edges may be the panel's";
      return result;
    }
    result.axis = answer.axis;
    result.planes_station = answer.planes_station;
    result.flags = joined_flags(answer.flags, pointing::kPointingFlagWords);
  } catch (const InputError& error) {
    result.refusal = "unreadable";
    result.advice = error.what();
  }
  return result;
}

PassResult solved(const PassJob& job) {
  const auto workspace = std::make_unique<pointing::PassWorkspace>();
  const pointing::PassSolution answer = pointing::estimate_pass(job.images, job.options, *workspace);
  PassResult result;
  if (answer.failure) result.refusal = pointing::name_of(*answer.failure);
  result.flags = pointing::name_of(job.options.law);
  result.estimate = answer.estimate;
  return result;
}

PointingResult failed(const PointingJob& job, const std::string& error) {
  if (const auto* image = std::get_if<ImageJob>(&job)) {
    ImageResult result;
    result.observation = image->observation;
    result.refusal = kInternalError;
    result.advice = image->file.string() + ": " + error;
    return result;
  }
  const auto& images = std::get<PassJob>(job).images;
  PassResult result;
  result.refusal = kInternalError;
  result.advice = error;
  result.flags = pointing::name_of(std::get<PassJob>(job).options.law);
  result.estimate.images = static_cast<int>(images.size());
  result.estimate.time_s = images.front().observation.time_s;
  return result;
}

}  // namespace

PointingWorker pointing_worker(const PinholeCamera& camera) {
  return PointingWorker(
      kMaxWaitingImages,
      [camera](const PointingJob& job) {
        if (const auto* image = std::get_if<ImageJob>(&job)) return PointingResult(measured(*image, camera));
        return PointingResult(solved(std::get<PassJob>(job)));
      },
      failed);
}

}  // namespace pharos::host
