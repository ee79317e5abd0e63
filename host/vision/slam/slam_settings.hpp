// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

namespace pharos::slam {

enum class Scene {
  kAuto,    ///< decided from the pictures until the map begins: see scene_of()
  kTarget,  ///< a body that moves in front of a dark or static background, which is masked
  kStatic,  ///< nothing is masked: the camera moves
};

inline const char* name_of(Scene scene) {
  return scene == Scene::kStatic ? "static" : scene == Scene::kTarget ? "target" : "auto";
}
/// That of the name; kAuto for any other.
inline Scene scene_named(const std::string& name) {
  return name == "static" ? Scene::kStatic : name == "target" ? Scene::kTarget : Scene::kAuto;
}

struct SlamSettings {
  Scene scene = Scene::kAuto;
  /// Of a frame; 0: by its size, 1000 for 640 x 480 pixels and more for larger images, so that they are as dense.
  int features = 0;
  bool close_loops = true;
  /// Of a target: the last adjustment takes a rotation at a constant rate about a fixed axis where no attitude
  /// contradicts it (SteadyRotation).
  bool steady_rotation = true;
  /// Tracking, mapping and loop closing each in its own thread; else in sequence, with identical results for the same
  /// input.
  bool threads = false;
  /// Every frame is kept for trajectory(). Else that is empty, figures are of the last frames, and memory does not grow
  /// with time: for an endless run.
  bool keep_trajectory = true;
  std::size_t max_keyframes = 0;  ///< 0: no limit; the paper's is 20
  std::string vocabulary;         ///< a file; empty: the one that ships
};

}  // namespace pharos::slam
