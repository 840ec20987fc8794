#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cases/papers/paper_rows.hpp"

namespace cases {

/// A paper whose examples the program computes.
struct Paper {
  std::string name;                                          // of the command and the folder: "scabbia2021"
  std::string title;                                         // authors, year, subject
  PaperResults (*run)(const std::filesystem::path& folder);  // which is the paper's own and exists
};

/// All papers, in the order of their years.
const std::vector<Paper>& papers();

/// The rows of a paper that was run.
struct PaperRun {
  std::string paper;
  std::vector<PaperRow> rows;
};

struct PaperOptions {
  std::string name;              // empty: all papers
  std::filesystem::path folder;  // of the results
  bool quiet = false;            // no line per paper
};

/// Runs the examples of one paper or of all: papers.json, papers.csv, report.html, and NAME/report.html with the curves
/// of each. Throws CaseError where there is no paper of this name, with those that there are, before anything is
/// written.
std::vector<PaperRun> run_papers(const PaperOptions& options);

/// papers.json: a list of objects with paper, item, quantity, published, claim, claim_holds, ours, reference,
/// reference_is, difference, processor_seconds; null where there is nothing.
std::string to_json(const std::vector<PaperRun>& runs);

/// An aligned table, one line per row.
std::string to_text(const std::vector<PaperRun>& runs);

}  // namespace cases
