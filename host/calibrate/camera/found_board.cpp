// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/camera/found_board.hpp"

namespace pharos::calibrate {

const char* name_of(ImageFate fate) {
  switch (fate) {
    case ImageFate::kUsed:
      return "used";
    case ImageFate::kNoBoard:
      return "no_board";
    case ImageFate::kPartlyOutside:
      return "partly_outside";
    case ImageFate::kIncomplete:
      return "incomplete";
    case ImageFate::kTooMany:
      return "too_many";
    case ImageFate::kBlurred:
      return "blurred";
    case ImageFate::kTooSmall:
      return "too_small";
    case ImageFate::kOtherSize:
      return "other_size";
    case ImageFate::kNoPartner:
      return "no_partner";
  }
  return "no_board";
}

}  // namespace pharos::calibrate
