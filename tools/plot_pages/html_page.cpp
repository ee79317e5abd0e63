// SPDX-License-Identifier: Apache-2.0
#include "tools/plot_pages/html_page.hpp"

#include <array>
#include <charconv>

#include "host/files/atomic_file.hpp"

namespace pharos::tools {
namespace {

constexpr const char* kStyle =
    "body{font-family:sans-serif;max-width:1000px;margin:1em auto;padding:0 1em;color:#202020;background:#fff}"
    "figure{margin:1em 0}figcaption{color:#505050;font-size:90%}svg{max-width:100%;height:auto}"
    "table{border-collapse:collapse;font-size:90%}td,th{border:1px solid #ccc;padding:2px 8px;text-align:left}";

std::string row_of(const std::vector<std::string>& cells, const char* kind) {
  std::string out = "<tr>";
  for (const std::string& cell : cells) {
    out += std::string("<") + kind + ">" + escaped_markup(cell) + "</" + kind + ">";
  }
  return out + "</tr>\n";
}

}  // namespace

HtmlPage::HtmlPage(std::string_view title) : title_(escaped_markup(title)) {}

void HtmlPage::heading(std::string_view words) { body_ += "<h2>" + escaped_markup(words) + "</h2>\n"; }
void HtmlPage::paragraph(std::string_view words) { body_ += "<p>" + escaped_markup(words) + "</p>\n"; }

void HtmlPage::figure(const Svg& picture, std::string_view caption) {
  ++figures_;
  body_ += "<figure>\n" + picture.element() + "<figcaption>" + escaped_markup(caption) + "</figcaption>\n</figure>\n";
}

void HtmlPage::table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows) {
  body_ += "<table>\n" + row_of(header, "th");
  for (const auto& row : rows) body_ += row_of(row, "td");
  body_ += "</table>\n";
}

void HtmlPage::write(const std::string& path) const {
  host::write_file(path, "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>" + title_ +
                             "</title>\n<style>" + kStyle + "</style>\n</head>\n<body>\n<h1>" + title_ + "</h1>\n" +
                             body_ + "</body>\n</html>\n");
}

std::string shown_number(double value, int digits) {
  std::array<char, 64> text{};
  return {text.data(),
          std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, digits).ptr};
}

}  // namespace pharos::tools
