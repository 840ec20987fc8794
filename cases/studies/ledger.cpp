#include "cases/studies/ledger.hpp"

#include <algorithm>
#include <array>
#include <exception>

#include "post/files/atomic_file.hpp"
#include "post/files/run_folder.hpp"
#include "post/files/table.hpp"

namespace cases {
namespace {

constexpr std::array<std::pair<RunOutcome, const char*>, 7> names_of_outcomes{{{RunOutcome::done, "done"},
                                                                               {RunOutcome::refused, "refused"},
                                                                               {RunOutcome::failed, "failed"},
                                                                               {RunOutcome::interrupted, "interrupted"},
                                                                               {RunOutcome::killed, "killed"},
                                                                               {RunOutcome::missing, "missing"},
                                                                               {RunOutcome::broken, "broken"}}};

constexpr std::array stages{"geometry", "families", "parameters",         "solve",
                            "srif",     "output",   "second_formulation", "processor"};

double median(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

std::optional<double> stage(const Cost& cost, const std::string& name) {
  for (const auto& [known, spent] : cost.seconds)
    if (known == name) return spent;
  return std::nullopt;
}

std::vector<post::Cell> row_of(const RunRecord& r) {
  std::vector<post::Cell> row{post::cell("./" + r.run),
                              post::cell("id " + r.digest),  // words, not numbers
                              post::cell("version " + r.version),
                              post::cell(name_of(r.outcome)),
                              post::cell(r.message),
                              double(r.cost.repeats),
                              post::cell(stage(r.cost, "total")),
                              r.cost.repeats > 0 ? post::Cell(r.cost.least) : post::Cell(),
                              r.cost.repeats > 0 ? post::Cell(r.cost.most) : post::Cell()};
  for (const char* name : stages) row.push_back(post::cell(stage(r.cost, name)));
  return row;
}

std::vector<std::string> columns() {
  std::vector<std::string> names{"run",     "digest",  "version",     "outcome",    "message",
                                 "repeats", "seconds", "seconds_min", "seconds_max"};
  for (const std::string name : stages) names.push_back(name + "_seconds");
  return names;
}

/// Reads a record; none with an outcome of another version.
std::optional<RunRecord> record_of(const post::Table& table, const std::vector<post::Cell>& row) {
  const auto word = [&](const char* column, std::size_t skip = 0) {
    const auto* text = std::get_if<std::string>(&row.at(table.column(column)));
    return text ? text->substr(std::min(skip, text->size())) : std::string();
  };
  const auto number = [&](const std::string& column) {
    const auto* value = std::get_if<double>(&row.at(table.column(column)));
    return value ? std::optional(*value) : std::nullopt;
  };
  const auto outcome = run_outcome(word("outcome"));
  if (!outcome) return std::nullopt;
  RunRecord record{word("run", 2), word("digest", 3), word("version", 8), *outcome, word("message")};
  record.cost.repeats = std::size_t(number("repeats").value_or(0));
  record.cost.least = number("seconds_min").value_or(0), record.cost.most = number("seconds_max").value_or(0);
  for (const std::string name : stages)
    if (const auto spent = number(name + "_seconds")) record.cost.seconds.emplace_back(name, *spent);
  if (const auto total = number("seconds")) record.cost.seconds.emplace_back("total", *total);
  return record;
}

constexpr std::string_view mark = "# ";  // of the last line: a comment with what the lines before it give

/// True where a record is as it was written, to the last bit.
bool whole(const std::string& text) {
  const auto end = text.rfind(mark);
  return end != std::string::npos && text.substr(end) == std::string(mark) + post::digest(text.substr(0, end)) + "\n";
}

}  // namespace

const char* name_of(RunOutcome outcome) {
  return std::ranges::find(names_of_outcomes, outcome, &std::pair<RunOutcome, const char*>::first)->second;
}

std::optional<RunOutcome> run_outcome(std::string_view name) {
  for (const auto& [outcome, known] : names_of_outcomes)
    if (name == known) return outcome;
  return std::nullopt;
}

Cost cost_of(const std::vector<std::vector<std::pair<std::string, double>>>& seconds) {
  Cost cost{seconds.size()};
  if (seconds.empty()) return cost;
  for (const auto& [name, first] : seconds.front()) {
    std::vector<double> all;
    for (const auto& one : seconds)
      for (const auto& [known, spent] : one)
        if (known == name) all.push_back(spent);
    cost.seconds.emplace_back(name, median(all));
    if (name == "total") cost.least = std::ranges::min(all), cost.most = std::ranges::max(all);
  }
  return cost;
}

std::optional<RunRecord> Ledger::known(const std::string& run) const {
  try {
    if (!std::filesystem::exists(file_of(run)) || !whole(post::read_text(file_of(run)))) return std::nullopt;
    const auto table = post::read_csv(file_of(run));
    return record_of(table, table.rows.at(0));
  } catch (const std::exception&) {
    return std::nullopt;  // of another version, or forgotten just now: the run is made anew
  }
}

std::optional<RunRecord> Ledger::done(const RunRecord& wanted, std::size_t repeats) const {
  auto found = known(wanted.run);
  if (!found || found->outcome != RunOutcome::done || found->digest != wanted.digest ||
      found->version != wanted.version || found->cost.repeats < repeats)
    return std::nullopt;
  return found;
}

void Ledger::put(const RunRecord& record) const {
  std::filesystem::create_directories(folder_);
  const auto text = post::csv_text({columns(), {row_of(record)}});
  post::write_atomically(file_of(record.run), text + std::string(mark) + post::digest(text) + "\n");
}

bool same_program(const RunRecord& record, const RunRecord& wanted) {
  const auto without_kernels = [](const std::string& version) { return version.substr(0, version.find(" AVX")); };
  return without_kernels(record.version) == without_kernels(wanted.version);
}

void write_records(const std::filesystem::path& file, std::vector<RunRecord> records) {
  post::Table table{columns(), {}};
  for (auto& record : records) {
    record.message = post::one_line(record.message);
    table.rows.push_back(row_of(record));
  }
  post::write_csv(file, table);
}

}  // namespace cases
