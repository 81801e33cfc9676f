// SPDX-License-Identifier: GPL-3.0-or-later
// Answer of --dry-run: what a study would compute, its cost, and its output file.
#include "dry_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <salebra/base/units.hpp>
#include <salebra/study/realisation.hpp>

#include "base/memory.hpp"
#include "option_words.hpp"

namespace salebra::cli {
namespace {

/// A time as text, rounded to one or two digits, since the estimate is not more accurate.
std::string about(double seconds) {
  if (seconds < 1) return "a second";
  const double unit = std::pow(10, std::floor(std::log10(seconds)) - (seconds < 100 ? 0 : 1));
  return format_duration(std::round(seconds / unit) * unit);
}

std::string in_points(const Grid2D& grid, const std::string& origin) {
  return fmt::format("{} x {} points, {} x {} ({})", grid.nx, grid.ny,
                     format_quantity(grid.lx, Dimension::length),
                     format_quantity(grid.ly, Dimension::length), origin);
}

std::string describe(const PointCost& point) {
  const Grid2D& grid = point.grid;
  std::string origin = "measured";
  if (const auto* generated = std::get_if<GeneratedSurfaces>(&point.configuration.surfaces)) {
    const auto [least, greatest] = std::ranges::minmax(generated->seeds);
    origin = title_of(generated->method);
    origin += least == greatest ? fmt::format(", seed {}", least)
                                : fmt::format(", seeds {} to {}", least, greatest);
  }
  return fmt::format("  surfaces  {} of {}\n  loads     {} from {} to {}, {:.2g} to {:.2g} E*h'\n",
                     point.surfaces, in_points(grid, origin), point.pressures.size(),
                     format_quantity(point.pressures.front(), Dimension::pressure),
                     format_quantity(point.pressures.back(), Dimension::pressure),
                     point.pressures.front() / point.contact_scale,
                     point.pressures.back() / point.contact_scale);
}

/// Says how many contacts the damping constants need in addition to the sweep of loads.
std::string describe_intervals(const StudyConfiguration& configuration, const StudyCost& cost) {
  double contacts = 0;
  for (const PointCost& point : cost.points)
    contacts += point.intervals * double(point.surfaces * point.pressures.size());
  return fmt::format("contacts inside the oscillation, as expensive as {:.0f} solves{}", contacts,
                     configuration.relative_error > 0
                         ? fmt::format("; for an error of {:.3g} % the cells of some loads are "
                                       "halved again, each time four to five times as expensive",
                                       100 * configuration.relative_error)
                         : "");
}

/// Formats processes as "64 on 16 machines, in 4 groups".
std::string describe(const StudyProcesses& processes) {
  return fmt::format("{} on {} machine{}{}", processes.ranks, processes.nodes,
                     processes.nodes > 1 ? "s" : "",
                     processes.groups > 1 ? fmt::format(", in {} groups", processes.groups) : "");
}

/// Factor by which the estimated time may be wrong.
int uncertainty(const StudyConfiguration& configuration) {
  return configuration.has(ContactModel::gw_interacting) ? 3 : 2;
}

/// Text with the resources that a job script should request for each shard. The estimates are
/// increased to allow for their error; factor: that of the time.
std::string describe_shards(const ShardPlan& plan, int threads, int factor, double wanted) {
  const auto minutes = 5 * static_cast<int>(std::ceil(factor * plan.seconds / 300));
  const double megabytes = 100 * std::ceil(1.25 * plan.memory / 100e6);
  return fmt::format(
      "shards    {} of at most {} surfaces, each about {} with {} threads and {}{}\n"
      "Slurm     --array=1-{} --cpus-per-task={} --mem={:.0f}M --time={:02}:{:02}:00\n",
      plan.shards, plan.surfaces, about(plan.seconds), threads, memory_text(plan.memory),
      plan.seconds > wanted ? "; a single surface takes longer than requested" : "", plan.shards,
      threads, megabytes, minutes / 60, minutes % 60);
}

}  // namespace

std::string format_duration(double seconds) {
  const auto whole = std::llround(std::max(seconds, 0.0));
  if (whole >= 3600) return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
  if (whole >= 60) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} s", whole);
}

void answer_dry_run(const StudyConfiguration& configuration, const StudyProcesses& processes,
                    std::optional<double> shard_seconds, Session& session) {
  const StudyCost cost = estimate_cost(configuration, processes);
  const bool together = processes.ranks > 1;
  require_that(!together || !shard_seconds, "--shard-seconds",
               "takes shards of one process each; leave out --ranks");
  const std::string file = session.has_output() ? session.output().string() : "";
  std::string text = "Dry run; nothing has been computed. The command would run:\n";
  for (const PointCost& point : cost.points) {
    if (!configuration.ensemble.empty())
      text += "== " + describe_point(configuration.ensemble, point.configuration) + " ==\n";
    text += describe(point);
    for (const std::string& warning : point.warnings)
      text += "  warning   " + in_options(warning) + "\n";
  }
  std::string models;
  for (const StudyModel& model : models_of(configuration))
    models += (models.empty() ? "" : "; ") + std::string(model.title);
  text += fmt::format(
      "\ncontacts  {} solves, with K{}\ndamping   {}\nmodels    {}\n{}time      {}about {} with {} "
      "threads {}, give or take a factor of {}\nmemory    about {}{}{}\n",
      cost.contacts(),
      stick_solves(configuration) ? " and K_t by a stick solve" : "; K_t = (G*/E*)K",
      describe_intervals(configuration, cost), models,
      together ? "processes " + describe(processes) + "\n" : "",
      configuration.target_precision > 0 ? "at most " : "", about(cost.seconds), cost.threads,
      together ? "each on idle machines like this one" : "on an idle machine",
      uncertainty(configuration) == 3 ? "three" : "two", memory_text(cost.memory_of_node()),
      together ? fmt::format(" on each machine, {} in each process", memory_text(cost.memory)) : "",
      cost.available > 0 ? fmt::format(" of {} that are free", memory_text(cost.available)) : "");
  text += file.empty() ? "files     none; add --output FILE to keep the results\n"
                       : fmt::format("files     {}; while it runs, finished surfaces in {}.parts\n",
                                     file, file);
  Json answer{{"dry_run", true}};
  answer.add(answer_json(cost));
  answer["files"]["results"] = file.empty() ? Json() : Json(file);
  if (shard_seconds) {
    const ShardPlan plan = plan_shards(cost, *shard_seconds);
    text += describe_shards(plan, cost.threads, uncertainty(configuration), *shard_seconds);
    answer["shards"] = json_of(plan);
  }
  if (cost.available > 0 && cost.memory_of_node() > cost.available)
    session.warn(fmt::format("the free memory is not enough; use fewer points or {}",
                             together ? "more machines" : "fewer --threads"));
  session.answer(answer, text);
}

SurfaceWork planned(const DryRunOptions& options, const Grid2D& grid, const Session& session) {
  SurfaceWork work;
  work.grid = grid;
  work.threads = parallel::threads();
  work.ranks = options.ranks > 0 ? options.ranks : session.communicator().size();
  const int here = memory_of_nodes(0, session.communicator()).nodes;
  work.nodes = options.nodes > 0 ? options.nodes : std::min(here, work.ranks);
  return work;
}

void answer_dry_run(const SurfaceWork& work, const std::string& origin, Session& session) {
  const Cost cost = estimate_cost(work);
  const double of_node = cost.memory_of_node(), available = cost.available;
  std::string text = "Dry run; nothing has been computed. The command would run:\n  surface   " +
                     in_points(work.grid, origin);
  if (!work.loads.empty())
    text += fmt::format("\n  contacts  {}, up to {:.2g} E*h'{}", work.loads.size(),
                        std::ranges::max(work.loads),
                        work.tangential_stiffness ? ", with K and K_t by a stick solve"
                        : work.normal_stiffness   ? ", with K"
                                                  : "");
  text += fmt::format("\n  processes {} of {} threads on {} machine{}{}\n\n", work.ranks,
                      work.threads, work.nodes, work.nodes > 1 ? "s" : "",
                      work.groups > 1 ? fmt::format(", in {} groups", work.groups) : "");
  text += fmt::format(
      "memory    about {} on each machine, {} in each process, give or take 15 %{}\n"
      "time      about {} on idle machines like this one, give or take a factor of two{}\n",
      memory_text(of_node), memory_text(cost.memory),
      available > 0 ? fmt::format("; {} are free on this one", memory_text(available)) : "",
      about(cost.seconds),
      cost.network_seconds > 0
          ? fmt::format("; {:.0f} % of it between machines, if these exchange {:.3g} GB/s, a "
                        "message in {:.2g} us",
                        100 * cost.network_seconds / cost.seconds, Cost::bandwidth / 1e9,
                        Cost::latency * 1e6)
          : "");
  Json answer{{"dry_run", true}};
  answer.add(json_of(work.grid));
  answer["contacts"] = work.loads.size();
  answer.add(json_of(cost));
  const double rows = double(work.grid.nx) * work.groups / work.ranks;
  if (rows < 64)
    session.warn(fmt::format(
        "each process has only {:.0f} rows; below 64 rows more processes take longer", rows));
  if (available > 0 && of_node > available)
    session.warn(fmt::format(
        "the free memory is not enough; use {:.0f} machines like this one, or fewer points",
        std::ceil(work.nodes * of_node / available)));
  session.answer(answer, text);
}

}  // namespace salebra::cli
