// SPDX-License-Identifier: Apache-2.0
#include "host/gige/list_cameras.hpp"

#include <arv.h>

#include <algorithm>

namespace pharos::host {
namespace {

std::string text_or_none(const char* text) { return text == nullptr ? "" : text; }

}  // namespace

std::vector<FoundCamera> list_cameras() {
  arv_disable_interface("USB3Vision");
  arv_update_device_list();
  std::vector<FoundCamera> cameras;
  for (unsigned i = 0; i < arv_get_n_devices(); ++i) {
    if (text_or_none(arv_get_device_protocol(i)) != "GigEVision") continue;
    cameras.push_back({text_or_none(arv_get_device_serial_nbr(i)), text_or_none(arv_get_device_address(i)),
                       text_or_none(arv_get_device_vendor(i)), text_or_none(arv_get_device_model(i))});
  }
  std::sort(cameras.begin(), cameras.end(),
            [](const FoundCamera& a, const FoundCamera& b) { return a.address < b.address; });
  return cameras;
}

}  // namespace pharos::host
