// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "host/daemon/source.hpp"
#include "host/device/camera_settings.hpp"
#include "host/device/frame_source.hpp"

namespace pharos::host {

/// A camera of the network, recorded where [recording] says so. `name`: of its recordings. Throws InputError.
std::unique_ptr<FrameSource> open_recorded_camera(const SourceContext& context, const CameraSettings& settings,
                                                  const std::string& name);

/// The camera's recordings in `frames` (a directory or a file), in step with all others. Throws InputError where there
/// are none, or of another camera.
std::unique_ptr<FrameSource> replayed_camera(const SourceContext& context, const std::filesystem::path& frames,
                                             const CameraSettings& settings, const std::string& name);

/// Counters of a recording; none where there is none.
void add_recording(NamedCounts& counts, const std::string& head, const FrameSourceStatus& camera);

}  // namespace pharos::host
