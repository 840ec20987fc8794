#pragma once
#include <filesystem>
#include <string>

namespace post {

struct StudyTable;
struct StudyTitles;

/// study.csv, study.json, orders.csv, the plots and report.html of a study, as far as it has come.
void write_study(const StudyTable& table, const StudyTitles& titles, const std::filesystem::path& folder);

/// The tables, the orders, the seconds by stage and the advice, and where the results are.
std::string printed_study(const StudyTable& table, const std::string& title, const std::filesystem::path& folder);

}  // namespace post
