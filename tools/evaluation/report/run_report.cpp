// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/report/run_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "host/files/atomic_file.hpp"
#include "host/support/input_error.hpp"
#include "pharos_commit.hpp"
#include "tools/evaluation/report/html.hpp"
#include "tools/evaluation/report/markdown.hpp"
#include "tools/evaluation/report/section.hpp"
#include "tools/support/output.hpp"

namespace pharos::tools::report {
namespace {

namespace fs = std::filesystem;

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw host::InputError(folder.string() + ": cannot be made: " + error.message());
}

bool among(const std::string& id, const std::vector<std::string>& ids) {
  return std::find(ids.begin(), ids.end(), id) != ids.end();
}

bool wanted(const Part& part, const std::vector<std::string>& only) { return only.empty() || among(part.id, only); }

PartSettings settings_of(const Part& part, const ReportOptions& options) {
  PartSettings settings = options.settings;
  settings.quick = settings.quick || among(part.id, options.quick);
  return settings;
}

FinishedPart computed(const Part& part, const PartSettings& settings, const fs::path& folder) {
  using Clock = std::chrono::steady_clock;
  std::error_code ignored;
  fs::remove_all(folder, ignored);  // of a run with other settings, or interrupted
  make_folder(folder);
  const auto start = Clock::now();
  FinishedPart finished{key_of(part.id, settings), part.command(settings), settings.quick, 0.0, {}};
  finished.result = part.run(settings, folder);
  finished.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  keep(finished, folder);
  return finished;
}

// Without the others' parts: what their tables and figures lack is not known.
std::vector<std::string> problems_of(const ReportContent& content) {
  std::vector<std::string> problems;
  for (const Exhibit& exhibit : exhibits()) {
    if (!all_parts_there(exhibit, content.parts)) continue;
    for (const std::string& words : missing_of(exhibit, result_of(exhibit, content.parts))) {
      problems.push_back(fmt::format("paper {}, {}: {}", exhibit.paper, exhibit.label, words));
    }
  }
  return problems;
}

}  // namespace

bool run_report(const std::vector<Part>& parts, const ReportOptions& options) {
  const fs::path folder(options.folder);
  make_folder(folder);
  if (!options.results.empty()) require_section(options.results);
  ReportContent content;
  content.commit = kCommit;
  content.seed = options.settings.seed;
  const auto count = std::count_if(parts.begin(), parts.end(), [&](const Part& p) { return wanted(p, options.only); });
  int number = 0;
  for (const Part& part : parts) {
    if (!wanted(part, options.only)) continue;
    ++number;
    const fs::path own = folder / part.id;
    const PartSettings settings = settings_of(part, options);
    auto kept = kept_part(own, key_of(part.id, settings));
    note(fmt::format("{} of {}: {}{}", number, count, part.id, kept ? " (kept from a former run)" : ""));
    content.parts[part.id] = kept ? std::move(*kept) : computed(part, settings, own);
    content.problems = problems_of(content);
    host::write_file((folder / "report.html").string(), html_of(content, folder));
    host::write_file((folder / "report.md").string(), markdown_of(content, 1));
  }
  if (!options.results.empty()) put_section(options.results, markdown_of(content, 2));
  for (const std::string& problem : content.problems) note(problem);
  note((folder / "report.html").string());
  return content.problems.empty();
}

}  // namespace pharos::tools::report
