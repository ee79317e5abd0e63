// SPDX-License-Identifier: Apache-2.0
#include "host/gige/find_camera.hpp"

#include <arpa/inet.h>

#include "host/gige/gige_camera.hpp"

namespace pharos::host {
namespace {

constexpr const char* kGigeVision = "GigEVision";

std::string text_or_empty(const char* text) { return text == nullptr ? "" : text; }

GObjectPtr<ArvCamera> open(const std::string& name) {
  ArvError error;
  GObjectPtr<ArvCamera> camera(arv_camera_new(name.c_str(), error.out()));
  if (camera && !error) return camera;
  throw CameraError(CameraState::kGone, "no camera answers at " + name + ": " + error.text() +
                                            "; is it powered, and is this computer on its network?");
}

// Searches the network; the message of a failure lists the cameras that responded.
std::string address_of_serial(const std::string& serial) {
  arv_disable_interface("USB3Vision");
  arv_update_device_list();
  std::string others;
  for (unsigned i = 0; i < arv_get_n_devices(); ++i) {
    if (text_or_empty(arv_get_device_protocol(i)) != kGigeVision) continue;
    const std::string found = text_or_empty(arv_get_device_serial_nbr(i));
    if (found == serial) return text_or_empty(arv_get_device_address(i));
    others += (others.empty() ? "" : ", ") + found;
  }
  throw CameraError(CameraState::kGone, "no camera with serial number " + serial + " answers; " +
                                            (others.empty() ? "none does" : "these do: " + others));
}

}  // namespace

std::string serial_of(ArvCamera* camera) {
  ArvError error;
  return text_or_empty(arv_camera_get_device_serial_number(camera, error.out()));
}

std::string address_of(ArvCamera* camera) {
  GSocketAddress* address = arv_gv_device_get_device_address(ARV_GV_DEVICE(arv_camera_get_device(camera)));
  if (address == nullptr || G_IS_INET_SOCKET_ADDRESS(address) == 0) return "";
  const GMemory<char> text(g_inet_address_to_string(g_inet_socket_address_get_address(G_INET_SOCKET_ADDRESS(address))));
  return text.get();
}

std::uint32_t ip_of(ArvCamera* camera) {
  in_addr address{};
  return ::inet_pton(AF_INET, address_of(camera).c_str(), &address) == 1 ? ntohl(address.s_addr) : 0;
}

GObjectPtr<ArvCamera> find_camera(const CameraSettings& settings) {
  GObjectPtr<ArvCamera> camera = open(settings.address.empty() ? address_of_serial(settings.serial) : settings.address);
  if (arv_camera_is_gv_device(camera.get()) == 0) {
    throw CameraError(CameraState::kWrong, "what answers is no GigE Vision camera");
  }
  // Until three seconds after another client's death the camera opens without an error but sends nothing.
  if (arv_gv_device_is_controller(ARV_GV_DEVICE(arv_camera_get_device(camera.get()))) == 0) {
    throw CameraError(CameraState::kTaken, "another program controls the camera at " + address_of(camera.get()) +
                                               "; end it (it is released 3 s after a program's death)");
  }
  const std::string serial = serial_of(camera.get());
  if (!settings.serial.empty() && serial != settings.serial) {
    throw CameraError(CameraState::kWrong, "the camera at " + address_of(camera.get()) + " has serial number " +
                                               serial + ", not " + settings.serial);
  }
  return camera;
}

}  // namespace pharos::host
