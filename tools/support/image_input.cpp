// SPDX-License-Identifier: Apache-2.0
#include "tools/support/image_input.hpp"

#include "tools/support/commands.hpp"
#include "tools/support/output.hpp"

namespace pharos::tools {

void ImageInput::remark_colour(const std::string& file) {
  if (remarked_) return;
  note(host::colour_remark(file));
  remarked_ = true;
}

host::GreyImage ImageInput::read(const std::string& path) {
  host::GreyImage image = host::read_grey_image(path);
  count_read(image.from_colour ? path : "");
  return image;
}

std::optional<host::GreyImage> ImageInput::try_read(const std::string& path) {
  try {
    return read(path);
  } catch (const host::InputError& error) {
    leave_out(error);
    return std::nullopt;
  }
}

void ImageInput::count_read(const std::string& colour_file) {
  ++read_;
  if (!colour_file.empty()) remark_colour(colour_file);
}

void ImageInput::leave_out(const host::InputError& error) {
  ++left_out_;
  note(error.what());
}

int ImageInput::finish(bool answered) const {
  const std::size_t all = read_ + left_out_;
  if (left_out_ > 0 && all > 1) {
    note(std::to_string(left_out_) + " of " + std::to_string(all) + " " + unit_ +
         "s could not be used and were left out");
  }
  return answered ? kExitAnswered : nothing_read() ? kExitUsage : kExitNoAnswer;
}

}  // namespace pharos::tools
