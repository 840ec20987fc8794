#pragma once
#include <filesystem>
#include <string>

#include "cases/studies/study_table.hpp"

namespace cases {

/// A way to run the cases of a study, by the labels of the axes that do not change the problem, and how exact and how
/// slow it is at worst over those that do (where references differ from label to label).
struct Way {
  std::string quantity, place;
  std::vector<std::pair<std::string, std::string>> labels;  // axis, label
  std::string method;                                       // of the factors
  double error = 0, seconds = 0;                            // |error|
};

/// Pareto front of every quantity with references: the ways that no other is both faster and more exact than, the
/// fastest first.
std::vector<Way> front(const StudyTable& study);

/// Advice in one sentence for each of these quantities: the fastest way of the front to 1 %, or else the most exact
/// one. None without references.
std::vector<std::string> advice(const StudyTable& study);

/// study.json: how many runs are done and what became of the others, front and advice.
std::string to_json(const std::string& title, const StudyTable& study);

struct StudyTable;
struct StudyTitles;

/// study.csv, study.json, orders.csv, the plots and report.html of a study, as far as it has come.
void write_study(const StudyTable& table, const StudyTitles& titles, const std::filesystem::path& folder);

/// The tables, the orders, the seconds by stage and the advice, and where the results are.
std::string printed_study(const StudyTable& table, const std::string& title, const std::filesystem::path& folder);

}  // namespace cases
