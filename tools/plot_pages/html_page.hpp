// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tools/plot/svg.hpp"

namespace pharos::tools {

/// A page of figures, tables and words in one HTML file: no script, nothing from the network.
class HtmlPage {
 public:
  explicit HtmlPage(std::string_view title);

  void heading(std::string_view words);
  void paragraph(std::string_view words);
  void figure(const Svg& picture, std::string_view caption);
  void table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows);

  /// Figures so far.
  int figures() const { return figures_; }
  /// Throws host::InputError when the file cannot be written.
  void write(const std::string& path) const;

 private:
  std::string title_;
  std::string body_;
  int figures_ = 0;
};

/// A number for people, with so many significant digits.
std::string shown_number(double value, int digits = 4);

}  // namespace pharos::tools
