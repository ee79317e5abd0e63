// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/report/run_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "host/files/atomic_file.hpp"
#include "host/support/input_error.hpp"
#include "pharos_commit.hpp"
#include "tools/evaluation/report/html.hpp"
#include "tools/support/output.hpp"

namespace pharos::tools::report {
namespace {

namespace fs = std::filesystem;

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw host::InputError(folder.string() + ": cannot be made: " + error.message());
}

bool wanted(const Part& part, const std::vector<std::string>& only) {
  return only.empty() || std::find(only.begin(), only.end(), part.id) != only.end();
}

FinishedPart computed(const Part& part, const ReportOptions& options, const fs::path& folder) {
  using Clock = std::chrono::steady_clock;
  std::error_code ignored;
  fs::remove_all(folder, ignored);  // of a run with other settings, or interrupted
  make_folder(folder);
  const auto start = Clock::now();
  FinishedPart finished{key_of(part.id, options.settings), part.command(options.settings), 0.0, {}};
  finished.result = part.run(options.settings, folder);
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
  ReportContent content;
  content.commit = kCommit;
  content.settings = options.settings;
  const auto count = std::count_if(parts.begin(), parts.end(), [&](const Part& p) { return wanted(p, options.only); });
  int number = 0;
  for (const Part& part : parts) {
    if (!wanted(part, options.only)) continue;
    ++number;
    const fs::path own = folder / part.id;
    auto kept = kept_part(own, key_of(part.id, options.settings));
    note(fmt::format("{} of {}: {}{}", number, count, part.id, kept ? " (kept from a former run)" : ""));
    content.parts[part.id] = kept ? std::move(*kept) : computed(part, options, own);
    content.problems = problems_of(content);
    host::write_file((folder / "report.html").string(), html_of(content, folder));
    host::write_file((folder / "report.md").string(), markdown_of(content));
  }
  for (const std::string& problem : content.problems) note(problem);
  note((folder / "report.html").string());
  return content.problems.empty();
}

}  // namespace pharos::tools::report
