// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/telescope_worker.hpp"

#include <memory>

#include "host/images/grey_image.hpp"
#include "host/support/flag_text.hpp"
#include "host/support/input_error.hpp"
#include "host/vision/line/measure_panel.hpp"

namespace pharos::host {
namespace {

constexpr std::size_t kMostWaitingImages = 512;  // a night's burst; then the oldest gives way

ImageResult measured(const ImageJob& job, const PinholeCamera& camera) {
  ImageResult result;
  result.sighting = job.sighting;
  try {
    const GreyImage image = read_grey_image(job.file.string());
    const auto panel = line::measure_panel(image.view(), camera);
    if (!panel) {
      result.refusal = line::name_of(panel.error());
      result.trouble = job.file.string() + ": " + line::advice_of(panel.error());
      return result;
    }
    const line::LineAnswer answer = line::answer_of(*panel, job.sighting.sight);
    result.axis = answer.axis;
    result.planes_station = answer.planes_station;
    result.flags = joined_flags(answer.flags, line::kLineFlagWords);
  } catch (const InputError& error) {
    result.refusal = "unreadable";
    result.trouble = error.what();
  }
  return result;
}

PassResult solved(const PassJob& job) {
  const auto workspace = std::make_unique<pointing::PassWorkspace>();
  return {pointing::estimate_pass(job.images, job.options, *workspace), {}};
}

TelescopeResult failed(const TelescopeJob& job, const std::string& trouble) {
  if (const auto* image = std::get_if<ImageJob>(&job)) {
    ImageResult result;
    result.sighting = image->sighting;
    result.refusal = kInternalError;
    result.trouble = image->file.string() + ": " + trouble;
    return result;
  }
  const auto& images = std::get<PassJob>(job).images;
  PassResult result;
  result.trouble = trouble;
  result.answer.estimate.images = static_cast<int>(images.size());
  result.answer.estimate.time_s = images.front().sighting.time_s;
  return result;
}

}  // namespace

TelescopeWorker telescope_worker(const PinholeCamera& camera) {
  return TelescopeWorker(
      kMostWaitingImages,
      [camera](const TelescopeJob& job) {
        if (const auto* image = std::get_if<ImageJob>(&job)) return TelescopeResult(measured(*image, camera));
        return TelescopeResult(solved(std::get<PassJob>(job)));
      },
      failed);
}

}  // namespace pharos::host
