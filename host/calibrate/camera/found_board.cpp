// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/camera/found_board.hpp"

namespace pharos::calibrate {

const char* name_of(ImageStatus status) {
  switch (status) {
    case ImageStatus::kUsed:
      return "used";
    case ImageStatus::kNoBoard:
      return "no_board";
    case ImageStatus::kPartlyOutside:
      return "partly_outside";
    case ImageStatus::kIncomplete:
      return "incomplete";
    case ImageStatus::kTooMany:
      return "too_many";
    case ImageStatus::kBlurred:
      return "blurred";
    case ImageStatus::kTooSmall:
      return "too_small";
    case ImageStatus::kOtherSize:
      return "other_size";
    case ImageStatus::kUnreadable:
      return "unreadable";
    case ImageStatus::kNoPartner:
      return "no_partner";
  }
  return "no_board";
}

}  // namespace pharos::calibrate
