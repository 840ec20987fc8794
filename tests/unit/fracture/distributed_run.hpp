#pragma once
#include <map>
#include <mutex>

#include "cases/driver/run.hpp"
#include "cases/input/case_file.hpp"
#include "plate/bonds/ordinary_plate.hpp"
#include "plate/model/loads.hpp"
#include "plate/model/supports.hpp"
#include "post/files/results_in_memory.hpp"
#include "post/files/summary.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/model/thread_ranks.hpp"

/// Whole runs of plates that threads share as processes do.
namespace shared_run {

/// The tables of a run: by the ordinary program, or as one of several processes.
inline std::map<std::string, post::Table> whole(const cases::CaseFile& file,
                                                const plate::Communicator& all = plate::single_process()) {
  post::ResultsInMemory kept;
  kept.wants_fields = false;
  cases::run(file, {{}, true, &kept, false, &all});
  return {kept.tables.begin(), kept.tables.end()};
}

/// Is a piece detached by then?
inline bool falls(const cases::CaseFile& file) {
  post::ResultsInMemory kept;
  kept.wants_fields = false;
  const auto summary = cases::run(file, {{}, true, &kept});
  return std::ranges::any_of(summary.energy, [](const auto& part) { return part.first == "frozen"; });
}

/// As text, of a run by so many processes, which all have the same.
inline std::map<std::string, std::string> texts(const cases::CaseFile& file, int processes) {
  std::map<std::string, std::string> result;
  std::mutex one_by_one;
  thread_ranks::run(processes, [&](const plate::Communicator& all) {
    std::map<std::string, std::string> own;
    for (const auto& [name, table] : whole(file, all)) own[name] = post::csv_text(table);
    const std::lock_guard guard(one_by_one);
    if (result.empty()) result = own;
    CHECK((result == own));
  });
  return result;
}

/// The largest difference of numbers of a table from those of a table as text, over the largest of its column.
inline double apart(const post::Table& table, const std::string& text) {
  std::istringstream lines(text);
  std::string line, cell;
  std::getline(lines, line);
  std::vector<double> largest(table.columns.size(), 0), off(table.columns.size(), 0);
  for (const auto& row : table.rows) {
    REQUIRE(std::getline(lines, line));
    std::istringstream cells(line);
    for (std::size_t c = 0; c < row.size(); ++c) {
      std::getline(cells, cell, ',');
      if (const auto* value = std::get_if<double>(&row[c])) {
        largest[c] = std::max(largest[c], std::abs(*value));
        off[c] = std::max(off[c], std::abs(*value - std::stod(cell)));
      }
    }
  }
  double result = 0;
  for (std::size_t c = 0; c < off.size(); ++c)
    if (largest[c] > 1e-9) result = std::max(result, off[c] / largest[c]);
  return result;
}

/// A plate 1 wide and 1.6 high on blocks of 16 rows, clamped below, with a crack along its middle that moments open.
inline cases::CaseFile tall_plate() {
  cases::CaseFile file;
  auto& c = file.content;
  c.section = {1000, 0.3, 0.05, 5.0 / 6, 2};
  c.outline = geometry::rectangle(0, 0, 1, 1.6);
  c.cracks = {{{0.5, 0.51}, {0.5, 0.91}}};
  c.discretization.spacing = 0.02;
  c.discretization.formulation = &plate::ordinary;
  c.supports = {{plate::SupportKind::clamped, {"bottom"}, {}}};
  c.loads = {plate::Load{plate::EdgeMoment{.edges = {"left", "right"}, .value = 1}}};
  auto& growth = c.growth.emplace();
  growth.fracture_energy = 100;
  c.output.vtk = c.output.hdf5 = false;
  return file;
}

/// With a crack from the left to the right edge in the end, across two borders of blocks, where it cuts off what is
/// above.
inline cases::CaseFile cut_plate() {
  auto file = tall_plate();
  auto& c = file.content;
  c.cracks = {{{0, 0.7}, {0.45, 0.98}}};
  c.loads.front().as<plate::EdgeMoment>()->edges = {"top"};
  c.growth->direction = fracture::Growth::Direction::straight;
  c.growth->detached = fracture::Growth::Detached::freeze;
  return file;
}

/// In motion by steps.
inline cases::CaseFile moving(cases::CaseFile file, double duration) {
  auto& c = file.content;
  c.analysis.kind = plate::Analysis::Kind::dynamic;
  c.analysis.method = plate::Analysis::Method::central_difference;
  c.analysis.duration = duration;
  c.output.history_every = duration / 20;
  return file;
}

}  // namespace shared_run
