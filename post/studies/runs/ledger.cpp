#include "post/studies/runs/ledger.hpp"

#include <algorithm>
#include <array>
#include <exception>

#include "post/figures/aligned.hpp"
#include "post/files/table.hpp"

namespace post {
namespace {

constexpr std::array stages{"geometry", "families", "parameters", "solve", "srif", "output", "second_formulation"};

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

Cell cell(const std::optional<double>& number) {
  return number ? Cell(*number) : Cell();
}

Cell cell(const std::string& word) {
  return word.empty() ? Cell() : Cell(word);
}

std::vector<Cell> row_of(const RunRecord& r) {
  std::vector<Cell> row{cell("./" + r.run),
                        cell("id " + r.digest),  // words, not numbers
                        cell("version " + r.version),
                        cell(r.outcome),
                        cell(one_line(r.message)),
                        double(r.cost.repeats),
                        cell(stage(r.cost, "total")),
                        r.cost.repeats > 0 ? Cell(r.cost.least) : Cell(),
                        r.cost.repeats > 0 ? Cell(r.cost.most) : Cell()};
  for (const char* name : stages) row.push_back(cell(stage(r.cost, name)));
  return row;
}

std::vector<std::string> columns() {
  std::vector<std::string> names{"run",     "digest",  "version",     "outcome",    "message",
                                 "repeats", "seconds", "seconds_min", "seconds_max"};
  for (const std::string name : stages) names.push_back(name + "_seconds");
  return names;
}

RunRecord record_of(const Table& table, const std::vector<Cell>& row) {
  const auto word = [&](const char* column, std::size_t skip = 0) {
    const auto* text = std::get_if<std::string>(&row.at(table.column(column)));
    return text ? text->substr(std::min(skip, text->size())) : std::string();
  };
  const auto number = [&](const std::string& column) {
    const auto* value = std::get_if<double>(&row.at(table.column(column)));
    return value ? std::optional(*value) : std::nullopt;
  };
  RunRecord record{word("run", 2), word("digest", 3), word("version", 8), word("outcome"), word("message")};
  record.cost.repeats = std::size_t(number("repeats").value_or(0));
  record.cost.least = number("seconds_min").value_or(0), record.cost.most = number("seconds_max").value_or(0);
  for (const std::string name : stages)
    if (const auto spent = number(name + "_seconds")) record.cost.seconds.emplace_back(name, *spent);
  if (const auto total = number("seconds")) record.cost.seconds.emplace_back("total", *total);
  return record;
}

}  // namespace

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

Ledger::Ledger(std::filesystem::path file) : file_(std::move(file)) {
  if (!std::filesystem::exists(file_)) return;
  try {
    const auto table = read_csv(file_);
    for (const auto& row : table.rows) records_.push_back(record_of(table, row));
  } catch (const std::exception&) {
    records_.clear();  // of another version: all runs are made anew
  }
}

std::optional<RunRecord> Ledger::done(const RunRecord& wanted, std::size_t repeats) const {
  const auto found = std::ranges::find(records_, wanted.run, &RunRecord::run);
  if (found == records_.end() || found->outcome != "done" || found->digest != wanted.digest ||
      found->version != wanted.version || found->cost.repeats < repeats)
    return std::nullopt;
  return *found;
}

void Ledger::put(RunRecord record) {
  const auto found = std::ranges::find(records_, record.run, &RunRecord::run);
  if (found == records_.end())
    records_.push_back(std::move(record));
  else
    *found = std::move(record);
  write();
}

void Ledger::forget(const std::string& run) {
  if (std::erase_if(records_, [&](const RunRecord& record) { return record.run == run; }) > 0) write();
}

void Ledger::write() const {
  Table table{columns(), {}};
  for (const auto& record : records_) table.rows.push_back(row_of(record));
  write_csv(file_, table);
}

}  // namespace post
