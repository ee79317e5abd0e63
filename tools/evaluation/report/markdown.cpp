// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/report/markdown.hpp"

#include <fmt/format.h>

namespace pharos::tools::report {
namespace {

std::string title(int level, const std::string& words) {
  return "\n" + std::string(static_cast<std::size_t>(level), '#') + " " + words + "\n";
}

std::string cell(std::string_view words) {
  std::string text;
  for (const char c : words) {
    if (c == '|') text += '\\';
    text += c;
  }
  return text;
}

std::string table_in_markdown(const std::vector<ComparisonRow>& rows) {
  if (rows.empty()) return "";
  std::string text =
      "\n| what | unit | published | theirs rerun | ours | ours / theirs | remark |\n|---|---|---|---|---|---|---|\n";
  for (const ComparisonRow& row : rows) {
    text += fmt::format("| {}: {} | {} | {} | {} | {} | {} | {} |\n", cell(row.item), cell(row.what), cell(row.unit),
                        cell(row.expected), shown(row.theirs, row.expected), shown(row.ours, row.expected),
                        shown(ratio_to_theirs(row), ""), cell(row.remark));
  }
  return text;
}

// Figures and tables that have no rows: one line each, a picture being in the page alone.
std::string without_rows(const Exhibit& exhibit) {
  std::string text = "- " + heading_of(exhibit) + ".";
  if (exhibit.picture) text += " Picture in the report.";
  if (!exhibit.remark.empty()) text += " " + std::string(exhibit.remark);
  return text + "\n";
}

std::string paper_in_markdown(const Paper& paper, const ReportContent& content, int level) {
  std::string text = title(level, fmt::format("Paper {}: {} ({})", paper.number, paper.title, paper.subject));
  std::string list;
  for (const Exhibit& exhibit : exhibits()) {
    if (exhibit.paper != paper.number) continue;
    const std::vector<ComparisonRow> rows = rows_of(exhibit, content);
    if (rows.empty()) {
      list += without_rows(exhibit);
      continue;
    }
    text += title(level + 1, heading_of(exhibit));
    if (!exhibit.remark.empty()) text += "\n" + std::string(exhibit.remark) + "\n";
    text += table_in_markdown(rows);
  }
  if (const auto rows = further_rows_of(paper, content); !rows.empty()) {
    text += title(level + 1, "Text, and what the paper leaves out") + table_in_markdown(rows);
  }
  if (!list.empty()) text += title(level + 1, "Without figures to compare") + "\n" + list;
  return text;
}

}  // namespace

std::string markdown_of(const ReportContent& content, int level) {
  std::string text = title(level, "Five papers: published, rerun, ours").substr(1) + "\n" + origin_of(content) +
                     " Theirs rerun: the published method on the same inputs as ours.\n";
  if (!content.parts.empty()) text += "\n";
  for (const auto& [id, part] : content.parts) text += fmt::format("- `{}`, {}\n", part.command, made_by(id, part));
  if (!content.problems.empty()) text += "\n";
  for (const std::string& problem : content.problems) text += "- missing: " + problem + "\n";
  for (const Paper& paper : papers()) text += paper_in_markdown(paper, content, level + 1);
  return text;
}

}  // namespace pharos::tools::report
