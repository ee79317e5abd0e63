// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <variant>

#include "host/publish/measurement_header.hpp"
#include "pharos/geometry/frames.hpp"
#include "pharos/geometry/pose_estimate.hpp"

namespace pharos::host {

/// A frame's name in messages.
template <class Frame>
inline constexpr const char* kFrameName = nullptr;
template <>
inline constexpr const char* kFrameName<frame::Lighthouse> = "lighthouse";
template <>
inline constexpr const char* kFrameName<frame::Body> = "body";
template <>
inline constexpr const char* kFrameName<frame::World> = "world";
template <>
inline constexpr const char* kFrameName<frame::Camera> = "camera";
template <>
inline constexpr const char* kFrameName<frame::Rig> = "rig";
template <>
inline constexpr const char* kFrameName<frame::Target> = "target";

/// The frames that a pose's type states.
template <class Parent, class Child>
constexpr FramePair frames_of(const PoseEstimate<Parent, Child>&) {
  static_assert(kFrameName<Parent> != nullptr && kFrameName<Child> != nullptr, "name the frame above");
  return {kFrameName<Parent>, kFrameName<Child>};
}
template <class... Poses>
FramePair frames_of(const std::variant<Poses...>& pose) {
  return std::visit([](const auto& one) { return frames_of(one); }, pose);
}

}  // namespace pharos::host
