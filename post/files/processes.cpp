#include "post/files/processes.hpp"

#include <fmt/format.h>
#include <omp.h>
#include <algorithm>

#include "plate/model/halo_exchange.hpp"
#include "plate/model/reduction.hpp"

namespace post {
namespace {

/// Spread of every number of a list over all ranks.
std::vector<Spread> spreads(const plate::Communicator& all, const std::vector<double>& own) {
  const auto found = plate::gathered(all, own);
  std::vector<Spread> result;
  for (std::size_t i = 0; i < own.size(); ++i) {
    Spread one{own[i], 0, own[i]};
    for (std::size_t n = i; n < found.size(); n += own.size())
      one.least = std::min(one.least, found[n]), one.largest = std::max(one.largest, found[n]), one.mean += found[n];
    one.mean /= double(all.size());
    result.push_back(one);
  }
  return result;
}

std::string range(const Spread& one, const char* unit, double scale = 1) {
  return fmt::format("{:.3g} to {:.3g}{}", one.least * scale, one.largest * scale, unit);
}

/// The traffic of this rank so far; zeros where one process has all.
plate::Traffic traffic_so_far(const plate::Communicator& all) {
  const auto* traffic = all.traffic();
  return traffic ? *traffic : plate::Traffic{};
}

}  // namespace

ProcessesOfRun::ProcessesOfRun() : ProcessesOfRun(plate::single_process()) {}

ProcessesOfRun::ProcessesOfRun(const plate::Communicator& all)
    : all_(&all), before_(std::make_shared<const plate::Traffic>(traffic_so_far(all))) {}

bool ProcessesOfRun::first() const {
  return all_->rank() == 0;
}

std::shared_ptr<const ProcessesSummary> ProcessesOfRun::summary(
    std::size_t points, const std::vector<std::pair<std::string, double>>& seconds, double memory,
    std::optional<double> steps) const {
  if (!all_->distributed()) return nullptr;
  const auto now = traffic_so_far(*all_), since = now - *before_;
  const double per_step = 1 / std::max(1.0, steps.value_or(1));
  std::vector<double> own{double(points),
                          memory,
                          now.seconds,
                          double(since.messages) * per_step,
                          double(since.bytes) * per_step,
                          double(since.sums) * per_step};
  for (const auto& stage : seconds) own.push_back(stage.second);
  const auto found = spreads(*all_, own);
  ProcessesSummary result{std::size_t(all_->size()),
                          std::size_t(omp_get_max_threads()),
                          found[0],
                          found[1],
                          {},
                          found[2],
                          steps,
                          found[3],
                          found[4],
                          found[5]};
  for (std::size_t i = 0; i < seconds.size(); ++i) result.seconds.emplace_back(seconds[i].first, found[6 + i]);
  return std::make_shared<const ProcessesSummary>(std::move(result));
}

std::string printed(const ProcessesSummary& processes) {
  const auto& [count, threads, points, memory, seconds, waiting, steps, messages, bytes, sums] = processes;
  constexpr double giga = 1e-9, kilo = 1e-3;
  std::string text =
      fmt::format("{} process{} of {} thread{}: {:.0f} to {:.0f} points and {} of memory each, {:.3g} GB in all\n",
                  count, count == 1 ? "" : "es", threads, threads == 1 ? "" : "s", points.least, points.largest,
                  range(memory, " GB", giga), memory.mean * giga * double(count));
  const auto total = std::ranges::find(seconds, "total", &std::pair<std::string, Spread>::first);
  if (total != seconds.end())
    text += fmt::format("waiting for each other {} of {:.3g} s\n", range(waiting, ""), total->second.largest);
  text +=
      fmt::format("to each {} messages of copies, {} and {:.3g} sums of all{}\n", range(messages, ""),
                  range(bytes, " kB", kilo), sums.mean, steps ? " a step or iteration, rows and frames counted" : "");
  return text;
}

}  // namespace post
