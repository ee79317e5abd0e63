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

std::string shown(const std::optional<double>& value) { return value ? rounded(*value) : ""; }

std::string table_of(const std::vector<ComparisonRow>& rows) {
  std::string text =
      "<table><tr><th>what</th><th>unit</th><th>published</th><th>theirs rerun</th><th>ours</th><th>ours / theirs</th>"
      "<th>remark</th></tr>\n";
  for (const ComparisonRow& row : rows) {
    text += fmt::format(
        "<tr><td>{}</td><td>{}</td><td class=n>{}</td><td class=n>{}</td><td class=n>{}</td><td class=n>{}</td>"
        "<td>{}</td></tr>\n",
        escaped(row.item + ": " + row.what), escaped(row.unit), escaped(row.expected), shown(row.theirs),
        shown(row.ours), shown(ratio_to_theirs(row)), escaped(row.remark));
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

std::vector<ComparisonRow> rows_of(const Exhibit& exhibit, const PartResult& result) {
  std::vector<ComparisonRow> rows;
  std::copy_if(result.rows.begin(), result.rows.end(), std::back_inserter(rows),
               [&](const ComparisonRow& row) { return is_of(exhibit, row.item); });
  return rows;
}

std::string heading(const Exhibit& exhibit) {
  std::string label(exhibit.label);
  label[0] = static_cast<char>(label[0] - 'a' + 'A');
  return label + ": " + std::string(exhibit.caption);
}

std::string section(const Exhibit& exhibit, const ReportContent& content, const std::filesystem::path& folder) {
  std::string text = "<h3>" + escaped(heading(exhibit)) + "</h3>\n";
  if (!exhibit.remark.empty()) text += "<p class=remark>" + escaped(exhibit.remark) + "</p>\n";
  if (exhibit.parts.empty()) return text;
  const PartResult result = result_of(exhibit, content.parts);
  if (all_parts_there(exhibit, content.parts)) {
    for (const std::string& words : missing_of(exhibit, result)) {
      text += "<p class=problem>" + escaped(words) + "</p>\n";
    }
  }
  const std::vector<ComparisonRow> rows = rows_of(exhibit, result);
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
    text += fmt::format("<p class=command><code>{}</code>, part {}: {:.0f} s</p>\n", escaped(part->second.command),
                        escaped(part->first), part->second.seconds);
  }
  return text;
}

// Rows of a paper that are of no numbered table or figure: text, and what the paper leaves out.
std::string further_rows(const Paper& paper, const ReportContent& content) {
  std::vector<ComparisonRow> rows;
  for (const auto& [id, part] : content.parts) {
    const bool of_paper = std::any_of(exhibits().begin(), exhibits().end(), [&id = id, &paper](const Exhibit& exhibit) {
      return exhibit.paper == paper.number &&
             std::find(exhibit.parts.begin(), exhibit.parts.end(), id) != exhibit.parts.end();
    });
    if (!of_paper) continue;
    for (const ComparisonRow& row : part.result.rows) {
      const bool numbered = std::any_of(exhibits().begin(), exhibits().end(), [&](const Exhibit& exhibit) {
        return exhibit.paper == paper.number && is_of(exhibit, row.item);
      });
      if (!numbered) rows.push_back(row);
    }
  }
  return rows.empty() ? "" : "<h3>Text, and what the paper leaves out</h3>\n" + table_of(rows);
}

std::string mode_of(const ReportContent& content) {
  return fmt::format("Commit {}, seed {}, {}.", content.commit, content.settings.seed,
                     content.settings.quick ? "quick: fewer and shorter runs" : "whole");
}

}  // namespace

bool all_parts_there(const Exhibit& exhibit, const std::map<std::string, FinishedPart>& parts) {
  return std::all_of(exhibit.parts.begin(), exhibit.parts.end(),
                     [&](std::string_view id) { return parts.contains(std::string(id)); });
}

PartResult result_of(const Exhibit& exhibit, const std::map<std::string, FinishedPart>& parts) {
  PartResult all;
  for (const std::string_view id : exhibit.parts) {
    const auto part = parts.find(std::string(id));
    if (part == parts.end()) continue;
    const PartResult& one = part->second.result;
    all.rows.insert(all.rows.end(), one.rows.begin(), one.rows.end());
    all.pictures.insert(all.pictures.end(), one.pictures.begin(), one.pictures.end());
  }
  return all;
}

std::string html_of(const ReportContent& content, const std::filesystem::path& folder) {
  std::string text =
      "<!DOCTYPE html>\n<html lang=en><head><meta charset=utf-8><title>Five papers, rerun</title><style>" +
      std::string(kStyle) + "</style></head><body>\n<h1>Five papers: published, rerun, ours</h1>\n<p>" +
      escaped(mode_of(content)) +
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

std::string markdown_of(const ReportContent& content) {
  std::string text = "# Five papers: published, rerun, ours\n\n" + mode_of(content) + "\n";
  for (const Paper& paper : papers()) {
    text += fmt::format("\n## Paper {}: {} ({})\n", paper.number, paper.title, paper.subject);
    for (const Exhibit& exhibit : exhibits()) {
      if (exhibit.paper != paper.number) continue;
      text += "\n### " + heading(exhibit) + "\n";
      if (!exhibit.remark.empty()) text += "\n" + std::string(exhibit.remark) + "\n";
      const std::vector<ComparisonRow> rows = rows_of(exhibit, result_of(exhibit, content.parts));
      if (rows.empty()) continue;
      text +=
          "\n| what | unit | published | theirs rerun | ours | ours / theirs | remark "
          "|\n|---|---|---|---|---|---|---|\n";
      for (const ComparisonRow& row : rows) {
        text += fmt::format("| {}: {} | {} | {} | {} | {} | {} | {} |\n", row.item, row.what, row.unit, row.expected,
                            shown(row.theirs), shown(row.ours), shown(ratio_to_theirs(row)), row.remark);
      }
    }
  }
  return text;
}

}  // namespace pharos::tools::report
