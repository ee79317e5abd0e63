// SPDX-License-Identifier: Apache-2.0
#include "host/gige/camera_ptp.hpp"

#include <array>

#include "host/gige/device_feature.hpp"
#include "host/gige/gobject.hpp"

namespace pharos::host {
namespace {

constexpr std::array<PtpNodes, 2> kNodes{
    {{"PtpEnable", "PtpStatus", "PtpDataSetLatch"}, {"GevIEEE1588", "GevIEEE1588Status", "GevIEEE1588DataSetLatch"}}};

}  // namespace

CameraPtp::CameraPtp(ArvDevice* device) : device_(device) {
  for (const PtpNodes& nodes : kNodes) {
    if (!has_feature(device_, nodes.enable) || !has_feature(device_, nodes.status)) continue;
    if (enable(nodes)) {
      nodes_ = &nodes;
      latches_ = has_feature(device_, nodes.latch);
      return;
    }
    without_nodes_ = PtpState::kRefused;
  }
}

// A camera may acknowledge the order and not obey it: the setting is read back.
bool CameraPtp::enable(const PtpNodes& nodes) const {
  ArvError error;
  arv_device_set_boolean_feature_value(device_, nodes.enable, TRUE, error.out());
  if (error) return false;
  return arv_device_get_boolean_feature_value(device_, nodes.enable, error.out()) != 0 && !error;
}

// Where the camera has the latch, the status is that of the last latch: without a new one it would stay for ever.
PtpState CameraPtp::read() const {
  if (nodes_ == nullptr) return without_nodes_;
  ArvError error;
  if (latches_) arv_device_execute_command(device_, nodes_->latch, error.out());
  if (error) return PtpState::kUnread;
  const char* word = arv_device_get_string_feature_value(device_, nodes_->status, error.out());
  return word == nullptr || error ? PtpState::kUnread : ptp_state_of(word);
}

}  // namespace pharos::host
