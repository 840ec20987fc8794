#include "cases/papers/papers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "cases/input/problems.hpp"
#include "cases/papers/dai2021.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/wording.hpp"
#include "post/files/atomic_file.hpp"
#include "post/files/table.hpp"
#include "post/report/html_report.hpp"
#include "post/report/terminal.hpp"

namespace cases {
namespace {

namespace fs = std::filesystem;

/// The rows of papers.csv.
post::Table table_of(const std::vector<PaperRun>& runs) {
  post::Table table{{"paper", "item", "quantity", "published", "claim", "claim_holds", "ours", "reference",
                     "reference_is", "difference", "processor_seconds"},
                    {}};
  for (const auto& run : runs)
    for (const auto& row : run.rows)
      table.rows.push_back({run.paper, row.item, row.quantity, post::cell(row.published),
                            row.claim ? post::cell(row.claim->text) : post::Cell(),
                            row.claim ? post::Cell(std::string(row.claim->holds ? "yes" : "no")) : post::Cell(),
                            row.ours, post::cell(row.reference), post::cell(row.reference_is),
                            post::cell(row.difference()), row.processor_seconds});
  return table;
}

std::vector<Paper> chosen_papers(const std::string& name) {
  if (name.empty()) return papers();
  std::vector<std::string> names;
  for (const auto& paper : papers()) {
    if (paper.name == name) return {paper};
    names.push_back(paper.name);
  }
  throw CaseError({{"papers", name,
                    fmt::format("there is no paper of this name, must be one of {}{}", fmt::join(names, ", "),
                                plate::did_you_mean(name, names))}});
}

/// A run whose numbers are no numbers has no results.
void check_rows(const PaperRun& run) {
  for (const auto& row : run.rows)
    if (!std::isfinite(row.ours))
      throw plate::NumericalError(fmt::format("{}: {}, {}: no finite number", run.paper, row.item, row.quantity));
}

}  // namespace

std::optional<double> PaperRow::difference() const {
  if (!reference) return std::nullopt;
  return *reference == 0 ? ours : (ours - *reference) / std::abs(*reference);
}

const std::vector<Paper>& papers() {
  static const std::vector<Paper> all{
      {"bode", "Bode: Peridynamic Galerkin methods, in the plane at small strains", bode},
      {"dai2021", "Dai, Tanaka, S. Oterkus, E. Oterkus (2021): intensity factors of cracked Mindlin plates", dai2021},
      {"scabbia2021", "Scabbia, Zaccariotto, Galvanetto (2021): fictitious nodes", scabbia2021},
      {"scabbia2023", "Scabbia, Zaccariotto, Galvanetto (2023): surface nodes in three dimensions", scabbia2023},
      {"scabbia_motion", "Scabbia, Zaccariotto, Galvanetto: surface nodes in motion", scabbia_motion}};
  return all;
}

std::vector<PaperRun> run_papers(const PaperOptions& options) {
  const auto chosen = chosen_papers(options.name);
  std::vector<PaperRun> runs;
  std::vector<std::string> names;
  for (const auto& paper : chosen) {
    const fs::path folder = options.folder / paper.name;
    fs::create_directories(folder);
    const auto results = paper.run(folder);
    runs.push_back({paper.name, results.rows});
    names.push_back(paper.name);
    check_rows(runs.back());
    const post::CurvePlot plot{paper.title, results.panels};
    if (!results.panels.empty()) post::write_atomically(folder / "curves.svg", post::to_svg(plot));
    post::write_papers_report(folder, plot, table_of({runs.back()}), {});
    post::write_atomically(options.folder / "papers.json", to_json(runs));
    post::write_csv(options.folder / "papers.csv", table_of(runs));
    post::write_papers_report(options.folder, {"Examples of the papers", {}}, table_of(runs), names);
    if (!options.quiet) post::say(fmt::format("{}: {} numbers\n", paper.name, results.rows.size()));
  }
  return runs;
}

std::string to_json(const std::vector<PaperRun>& runs) {
  using Json = nlohmann::ordered_json;
  const auto number = [](const std::optional<double>& x) { return x && std::isfinite(*x) ? Json(*x) : Json(); };
  Json list = Json::array();
  for (const auto& run : runs)
    for (const auto& row : run.rows)
      list.push_back({{"paper", run.paper},
                      {"item", row.item},
                      {"quantity", row.quantity},
                      {"published", number(row.published)},
                      {"claim", row.claim ? Json(row.claim->text) : Json()},
                      {"claim_holds", row.claim ? Json(row.claim->holds) : Json()},
                      {"ours", number(row.ours)},
                      {"reference", number(row.reference)},
                      {"reference_is", row.reference_is.empty() ? Json() : Json(row.reference_is)},
                      {"difference", number(row.difference())},
                      {"processor_seconds", number(row.processor_seconds)}});
  return list.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string to_text(const std::vector<PaperRun>& runs) {
  using Text = std::function<std::string(const PaperRun&, const PaperRow&)>;
  const auto number = [](const std::optional<double>& x) { return x ? fmt::format("{:.6g}", *x) : std::string(); };
  std::vector<post::TextColumn> columns;
  const auto add = [&](const std::string& title, bool is_number, const Text& text) {
    columns.push_back({title, is_number});
    for (const auto& run : runs)
      for (const auto& row : run.rows) columns.back().cells.push_back(text(run, row));
  };
  add("paper", false, [](const PaperRun& run, const PaperRow&) { return run.paper; });
  add("item", false, [](const PaperRun&, const PaperRow& row) { return row.item; });
  add("quantity", false, [](const PaperRun&, const PaperRow& row) { return row.quantity; });
  add("published", true, [&](const PaperRun&, const PaperRow& row) { return number(row.published); });
  add("ours", true, [&](const PaperRun&, const PaperRow& row) { return number(row.ours); });
  add("reference", true, [&](const PaperRun&, const PaperRow& row) { return number(row.reference); });
  add("difference", true, [](const PaperRun&, const PaperRow& row) {
    return row.difference() ? fmt::format("{:.2e}", *row.difference()) : std::string();
  });
  add("s", true, [](const PaperRun&, const PaperRow& row) { return fmt::format("{:.2f}", row.processor_seconds); });
  add("the paper says", false, [](const PaperRun&, const PaperRow& row) {
    return row.claim ? row.claim->text + (row.claim->holds ? ": holds" : ": does not hold") : std::string();
  });
  return post::aligned(columns);
}

}  // namespace cases
