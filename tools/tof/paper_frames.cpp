// SPDX-License-Identifier: Apache-2.0
#include "tools/tof/paper_frames.hpp"

#include <filesystem>
#include <optional>

#include "host/cameras/camera_file.hpp"
#include "host/device/frame_directory.hpp"
#include "host/support/input_error.hpp"
#include "tools/support/commands.hpp"
#include "tools/support/image_input.hpp"
#include "tools/support/progress.hpp"
#include "tools/tof/paper/paper_chain.hpp"
#include "tools/tof/paper/paper_pictures.hpp"
#include "tools/tof/tof_rows.hpp"

namespace pharos::tools {
namespace {

class PaperMeasurer {
 public:
  explicit PaperMeasurer(const PaperFramesOptions& options)
      : options_(options), camera_(host::read_camera_file(options.camera).camera), frames_(options.folder) {
    settings_.printed_threshold = options.printed_threshold;
  }

  std::size_t frames() const { return frames_.frames(); }
  const std::string& name(std::size_t index) const { return frames_.name(index); }
  const ImageInput& input() const { return input_; }

  /// Nothing where the frame cannot be read.
  std::optional<paper000::ChainResult> measure(std::size_t index) {
    host::DepthFrame frame;
    try {
      input_.count_read(frames_.read(index, camera_.intrinsics.width_px, camera_.intrinsics.height_px, frame));
    } catch (const host::InputError& error) {
      input_.leave_out(error);
      return std::nullopt;
    }
    const paper000::DepthView depth = frame.depth_view();
    const std::vector<std::uint16_t> rounded = paper000::eight_bit_depth(depth, camera_);
    auto result = paper000::measure({rounded.data(), depth.width_px, depth.height_px}, camera_, settings_);
    if (!options_.stages.empty()) {
      const std::string prefix = (std::filesystem::path(options_.stages) / (name(index) + '_')).string();
      paper000::write_amplitude_picture(prefix, frame.intensity_view());
      if (!result.stages.grey.empty()) paper000::write_stage_pictures(prefix, result.stages);
    }
    return result;
  }

 private:
  const PaperFramesOptions& options_;
  DepthCamera camera_;
  host::FrameDirectory frames_;
  ImageInput input_{"frame"};
  paper000::ChainSettings settings_;
};

// Word after refused_; empty of a frame with a pose.
std::string reason_of(const std::optional<paper000::ChainResult>& result) {
  if (!result) return "unreadable";
  return result->failure ? std::string(paper000::name_of(*result->failure)) : "";
}

void make_folder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw host::InputError(folder + ": cannot be made: " + error.message());
}

}  // namespace

int run_paper_frames(const PaperFramesOptions& options) {
  PaperMeasurer measurer(options);
  if (!options.stages.empty()) make_folder(options.stages);
  Output output(options.output, options.summary ? summary_columns() : tof_columns());
  PoseSummary summary;
  Progress progress("tof", "frames", measurer.frames());
  std::string last_reason;
  for (std::size_t k = 0; k < measurer.frames(); ++k) {
    const auto result = measurer.measure(k);
    const std::string reason = reason_of(result);
    if (reason.empty()) {
      summary.add({*result->pose, Matrix6::Zero()}, true);
      if (!options.summary) write_paper_frame(output.rows(), measurer.name(k), *result->pose);
    } else {
      last_reason = reason;
      if (!options.summary) write_refusal(output.rows(), measurer.name(k), reason);
    }
    progress.step();
  }
  const bool answered = summary.frames() > 0;
  if (options.summary && answered) write_summary(output.rows(), summary, SummaryRows::kMeasured);
  output.finish();
  if (!answered) note(options.folder + ": no frame has a pose; the last one was refused_" + last_reason);
  return measurer.input().finish(answered);
}

}  // namespace pharos::tools
