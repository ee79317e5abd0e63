// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/report/html.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "host/support/input_error.hpp"

namespace pharos::tools::report {
namespace {

constexpr const char* kStyle =
    "body{font-family:sans-serif;max-width:1200px;margin:1em auto;padding:0 1em;color:#202020}"
    "table{border-collapse:collapse;margin:.5em 0}td,th{border:1px solid #c0c0c0;padding:2px 8px;text-align:left}"
    "td.n{text-align:right;font-variant-numeric:tabular-nums}h3{margin:1.6em 0 .2em}"
    ".remark{color:#404040}.command{color:#606060;font-size:90%}.problem{color:#b00020;font-weight:bold}"
    "figure{margin:.5em 0}figcaption{color:#404040;font-size:90%}img,svg{max-width:100%;height:auto}";

std::string escaped(std::string_view words) {
  std::string text;
  for (const char c : words) {
    switch (c) {
      case '<':
        text += "&lt;";
        break;
      case '>':
        text += "&gt;";
        break;
      case '&':
        text += "&amp;";
        break;
      case '"':
        text += "&quot;";
        break;
      default:
        text += c;
    }
  }
  return text;
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw host::InputError(path.string() + ": cannot be read");
  return {std::istreambuf_iterator<char>(file), {}};
}

// RFC 4648.
std::string base64(const std::string& bytes) {
  constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8U | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? kLetters[group >> (18U - 6U * k) & 63U] : '=';
  }
  return text;
}

std::string table_of(const std::vector<ComparisonRow>& rows) {
  std::string text =
      "<table><tr><th>what</th><th>unit</th><th>published</th><th>theirs rerun</th><th>ours</th><th>ours / theirs</th>"
      "<th>remark</th></tr>\n";
  for (const ComparisonRow& row : rows) {
    text += fmt::format(
        "<tr><td>{}</td><td>{}</td><td class=n>{}</td><td class=n>{}</td><td class=n>{}</td><td class=n>{}</td>"
        "<td>{}</td></tr>\n",
        escaped(row.item + ": " + row.what), escaped(row.unit), escaped(row.expected), shown(row.theirs, row.expected),
        shown(row.ours, row.expected), shown(ratio_to_theirs(row), ""), escaped(row.remark));
  }
  return text + "</table>\n";
}

std::string picture_of(const Picture& picture, const std::filesystem::path& folder) {
  const std::string bytes = bytes_of(folder / picture.file);
  const std::string image =
      picture.file.ends_with(".svg")
          ? bytes
          : "<img alt=\"" + escaped(picture.label) + "\" src=\"data:image/png;base64," + base64(bytes) + "\">";
  return "<figure>" + image + "<figcaption>" + escaped(picture.label + ": " + picture.caption) +
         "</figcaption></figure>\n";
}

std::string section(const Exhibit& exhibit, const ReportContent& content, const std::filesystem::path& folder) {
  std::string text = "<h3>" + escaped(heading_of(exhibit)) + "</h3>\n";
  if (!exhibit.remark.empty()) text += "<p class=remark>" + escaped(exhibit.remark) + "</p>\n";
  if (exhibit.parts.empty()) return text;
  const PartResult result = result_of(exhibit, content.parts);
  if (all_parts_there(exhibit, content.parts)) {
    for (const std::string& words : missing_of(exhibit, result)) {
      text += "<p class=problem>" + escaped(words) + "</p>\n";
    }
  }
  const std::vector<ComparisonRow> rows = rows_of(exhibit, content);
  if (!rows.empty()) text += table_of(rows);
  for (const std::string_view id : exhibit.parts) {
    const auto part = content.parts.find(std::string(id));
    if (part == content.parts.end()) {
      text += "<p class=remark>Part " + escaped(id) + " was not run.</p>\n";
      continue;
    }
    for (const Picture& picture : part->second.result.pictures) {
      if (is_of(exhibit, picture.label)) text += picture_of(picture, folder / part->first);
    }
    text += fmt::format("<p class=command><code>{}</code>, {}</p>\n", escaped(part->second.command),
                        escaped(made_by(id, part->second)));
  }
  return text;
}

std::string further_rows(const Paper& paper, const ReportContent& content) {
  const std::vector<ComparisonRow> rows = further_rows_of(paper, content);
  return rows.empty() ? "" : "<h3>Text, and what the paper leaves out</h3>\n" + table_of(rows);
}

}  // namespace

std::string html_of(const ReportContent& content, const std::filesystem::path& folder) {
  std::string text =
      "<!DOCTYPE html>\n<html lang=en><head><meta charset=utf-8><title>Five papers, rerun</title><style>" +
      std::string(kStyle) + "</style></head><body>\n<h1>Five papers: published, rerun, ours</h1>\n<p>" +
      escaped(origin_of(content)) +
      " Theirs rerun: the published method on the same inputs as ours. A ratio stands only where both "
      "measure the same thing.</p>\n";
  for (const std::string& problem : content.problems) text += "<p class=problem>" + escaped(problem) + "</p>\n";
  for (const Paper& paper : papers()) {
    text += "<h2>" + escaped(fmt::format("Paper {}: {} ({})", paper.number, paper.title, paper.subject)) + "</h2>\n";
    for (const Exhibit& exhibit : exhibits()) {
      if (exhibit.paper == paper.number) text += section(exhibit, content, folder);
    }
    text += further_rows(paper, content);
  }
  return text + "</body></html>\n";
}

}  // namespace pharos::tools::report
