// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "host/calibrate/camera/camera_calibration.hpp"
#include "host/cameras/calibration_record.hpp"
#include "tools/support/output.hpp"

namespace pharos::tools {

/// `parameter,value,sigma`, in the parameters' own units.
void write_board_parameters(const calibrate::BundleOutcome& outcome, const OutputOptions& options);

/// `image,status,points,rms_px,detail`: every image that was given.
void write_image_statuses(const std::vector<calibrate::ImageOutcome>& images, const OutputOptions& options);

/// `image,point,u_px,v_px,du_px,dv_px`: each point of the images used, and by how much it was found beside where the
/// camera sees it.
void write_board_points(const calibrate::CameraCalibration& result, const calibrate::Board& board,
                        const OutputOptions& options);

/// On standard error: how many images were used, and why the others were not.
void note_images(const std::vector<calibrate::ImageOutcome>& images);

/// On standard error: residuals of the points, and images with much larger residuals than the others.
void note_fit(const calibrate::BundleOutcome& outcome, const std::vector<calibrate::ImageOutcome>& images,
              const calibrate::Board& board);

/// On standard error: where in the image points were.
void note_coverage(const calibrate::Coverage& coverage, const std::string& whose);

/// The record that is written to the file beside the values.
host::CalibrationRecord record_of(const calibrate::BundleOutcome& outcome, std::size_t points,
                                  const std::vector<std::string>& unobservable);

}  // namespace pharos::tools
