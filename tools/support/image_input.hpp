// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "host/images/grey_image.hpp"
#include "host/support/input_error.hpp"

namespace pharos::tools {

/// The images of one command. An image that cannot be read is reported, counted and left out; the conversion of colour
/// to luma is reported once, whatever the number of images.
class ImageInput {
 public:
  /// `unit`: what is counted, in the singular: "image", "frame", "pair".
  explicit ImageInput(std::string unit = "image") : unit_(std::move(unit)) {}

  /// An image that the command requires. Throws InputError as host::read_grey_image does.
  host::GreyImage read(const std::string& path);
  /// One of many: empty where it cannot be read, which is reported and counted.
  std::optional<host::GreyImage> try_read(const std::string& path);

  /// For images that the caller reads: counts one that was read, with the name of a file that was converted to luma (or
  /// none).
  void count_read(const std::string& colour_file = "");
  /// Counts one that could not be read or used, and reports why.
  void leave_out(const host::InputError& error);

  std::size_t left_out() const { return left_out_; }
  /// Some could not be read, and none could.
  bool nothing_read() const { return read_ == 0 && left_out_ > 0; }
  /// After the last one: reports how many of several were left out, and returns the command's exit code: kExitUsage
  /// where none could be read.
  int finish(bool answered) const;

 private:
  void remark_colour(const std::string& file);

  std::string unit_;
  std::size_t read_ = 0, left_out_ = 0;
  bool remarked_ = false;
};

}  // namespace pharos::tools
