// SPDX-License-Identifier: Apache-2.0
// pharos solve: tables of bearings to poses, without any recording.
#include "pharos/pose/solve.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <map>

#include "host/table/table_reader.hpp"
#include "host/table/target_file.hpp"
#include "tools/support/commands.hpp"
#include "tools/support/output.hpp"
#include "tools/support/pose_columns.hpp"
#include "tools/support/progress.hpp"
#include "tools/support/solver_options.hpp"
#include "tools/support/standard_input.hpp"
#include "tools/support/target_notes.hpp"

namespace pharos::tools {
namespace {

constexpr const char* kExample =
    "Example:\n"
    "  pharos solve problems.csv --target target.csv --sigma-arcsec 60 --time 100 > poses.csv\n"
    "problems.csv: problem,sensor,theta_x_rad,theta_y_rad, rows with one name in `problem` belong together; either\n"
    "angle may be empty; several rows of one sensor are candidates of which one at most is used. A problem of more "
    "than\n"
    "128 angles is refused (refused_too_many_angles).";

struct Options {
  std::string problems;
  std::string target;
  int repeats = 0;
  SolverOptions solver;
  OutputOptions output;
};

struct Problem {
  std::string name;
  std::vector<pose::Observation> observations;  // as many as the table gives

  bool fits() const { return observations.size() <= pose::kMaxObservations; }
};

pose::Observations observations_of(const Problem& problem) {
  pose::Observations observations;
  for (const pose::Observation& observation : problem.observations) observations.push_back(observation);
  return observations;
}

void add_row(const host::TableReader& table, Problem& problem) {
  const auto sensor = static_cast<std::uint8_t>(table.integer(1, 0, 255));
  const std::array<std::optional<double>, kAxes> theta = {table.optional_number(2), table.optional_number(3)};
  for (const Axis axis : {Axis::kX, Axis::kY}) {
    const std::optional<double>& angle = theta[static_cast<std::size_t>(index_of(axis))];
    if (angle) problem.observations.push_back({sensor, axis, *angle});
  }
}

// In the order in which problems first appear; their rows need not be contiguous.
std::vector<Problem> read_problems(const std::string& path) {
  host::TableReader table(host::ByteSource(path), {"problem", "sensor", "theta_x_rad", "theta_y_rad"});
  std::vector<Problem> problems;
  std::map<std::string, std::size_t, std::less<>> index;
  while (table.next()) {
    const std::string_view name = table.text(0);
    if (problems.empty() || problems.back().name != name) {
      const auto [place, added] = index.try_emplace(std::string(name), problems.size());
      if (added) {
        problems.push_back({std::string(name), {}});
      } else {
        add_row(table, problems[place->second]);
        continue;
      }
    }
    add_row(table, problems.back());
  }
  return problems;
}

std::vector<std::string> columns() {
  std::vector<std::string> last = {"rms_arcsec", "adop_deg_per_rad", "pdop_m_per_rad", "iterations", "status"};
  for (const std::string& column : second_solution_columns()) last.push_back(column);
  last.insert(last.end(), {"sigma_rot_deg", "sigma_pos_mm", "observations"});
  return with_pose_columns({"problem"}, last);
}

void write_refusal(const Problem& problem, const char* reason, host::RowWriter& rows) {
  rows.text(problem.name);
  write_no_pose(rows);
  rows.none(4).text(std::string("refused_") + reason);
  write_second_solution(rows, nullptr);
  rows.none(2).integer(static_cast<std::int64_t>(problem.observations.size())).end_row();
}

void write_solution(const Problem& problem, const LighthousePoseEstimate& estimate, host::RowWriter& rows) {
  rows.text(problem.name);
  write_pose(rows, estimate.pose);
  rows.number(estimate.residual_rms * kArcsecPerRad).number(estimate.adop_deg_per_rad).number(estimate.pdop_m_per_rad);
  rows.integer(estimate.iterations).text(status_of(estimate));
  write_second_solution(rows, &estimate);
  rows.number(estimate.sigma_rotation_rad() * kDegPerRad).number(estimate.sigma_position_m() * kMmPerM);
  rows.integer(estimate.observations).end_row();
}

// Whether the problem was solved.
bool solve_problem(const Problem& problem, const Target& target, const pose::SolveOptions& options,
                   host::RowWriter& rows) {
  if (!problem.fits()) {
    write_refusal(problem, "too_many_angles", rows);
    return false;
  }
  const auto solution = pose::solve(target, observations_of(problem), options);
  if (solution) {
    write_solution(problem, solution->estimate, rows);
  } else {
    write_refusal(problem, pose::name_of(solution.error()), rows);
  }
  return static_cast<bool>(solution);
}

// Every solve is timed separately; the median does not depend on other load of the machine.
double median_ns(const std::vector<Problem>& problems, const Target& target, const pose::SolveOptions& options,
                 int repeats) {
  std::vector<double> times_ns;
  times_ns.reserve(problems.size() * static_cast<std::size_t>(repeats));
  Progress progress("timing", "rounds", static_cast<std::size_t>(repeats));
  for (int round = 0; round < repeats; ++round) {
    for (const Problem& problem : problems) {
      if (!problem.fits()) continue;
      const pose::Observations observations = observations_of(problem);
      const auto start = std::chrono::steady_clock::now();
      const auto solution = pose::solve(target, observations, options);
      const std::chrono::duration<double, std::nano> taken = std::chrono::steady_clock::now() - start;
      if (solution) times_ns.push_back(taken.count());
    }
    progress.step();
  }
  if (times_ns.empty()) return 0.0;
  const auto middle = times_ns.begin() + static_cast<std::ptrdiff_t>(times_ns.size() / 2);
  std::nth_element(times_ns.begin(), middle, times_ns.end());
  return *middle;
}

int run(const Options& options) {
  require_one_standard_input({{"PROBLEMS", options.problems}, {"--target", options.target}});
  const host::TargetFile target = host::read_target(options.target);
  note_target_shape(options.target, target.shape);
  const std::vector<Problem> problems = read_problems(options.problems);
  const pose::SolveOptions solve_options = options.solver.solve();
  Output output(options.output, columns());
  Progress progress("solve", "problems", problems.size());
  std::size_t answered = 0;
  for (const Problem& problem : problems) {
    if (solve_problem(problem, target.target, solve_options, output.rows())) ++answered;
    progress.step();
  }
  output.finish();
  if (answered == 0) {
    note(options.problems +
         (problems.empty() ? ": no problem in the table" : ": every problem was refused; see status"));
    return kExitNoAnswer;
  }
  if (options.repeats > 0) {
    std::fprintf(stderr, "median %.0f ns per solve (%zu problems solved, %d times each)\n",
                 median_ns(problems, target.target, solve_options, options.repeats), answered, options.repeats);
  }
  return kExitAnswered;
}

}  // namespace

void add_solve(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("solve", "Tables of bearings and a target to poses");
  const auto options = std::make_shared<Options>();
  command
      ->add_option("PROBLEMS", options->problems,
                   "Table problem,sensor,theta_x_rad,theta_y_rad (paper's angles); .gz; - is standard input")
      ->required();
  command->add_option("--target", options->target, "Table sensor,x_m,y_m,z_m[,nx,ny,nz]")->required();
  command->add_option("--time", options->repeats, "Solve everything so many times more; median ns on standard error")
      ->check(CLI::Range(1, 1'000'000));
  add_solver_options(*command, options->solver);
  add_output_options(*command, options->output);
  command->footer(kExample);
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace pharos::tools
