#pragma once
#include <ctime>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "post/report/curve_plot.hpp"

namespace cases {

/// Statement of a paper on a number in words, and whether it holds of ours.
struct Claim {
  std::string text;
  bool holds = false;
};

/// A number of an example: as the paper has it, as it is computed here, and by other means than those of the paper.
struct PaperRow {
  std::string item;      // section and example
  std::string quantity;  // with its unit
  double ours = 0;
  std::optional<double> published = std::nullopt;
  std::optional<Claim> claim = std::nullopt;
  std::optional<double> reference = std::nullopt;
  std::string reference_is = {};  // closed form, series, quadrature, finite elements
  double processor_seconds = 0;   // of the example that the row is of
  /// Ours less the reference, over the reference; as it is where that is 0. None without a reference.
  std::optional<double> difference() const;
};

/// Processor time since it was made.
class ProcessorWatch {
public:
  double seconds() const { return double(std::clock() - begun_) / CLOCKS_PER_SEC; }

private:
  std::clock_t begun_ = std::clock();
};

/// Rows and curves of a paper.
struct PaperResults {
  std::vector<PaperRow> rows;
  std::vector<post::Panel> panels;

  /// Adds a row with the processor time until now. Returns it for what else is known of it.
  PaperRow& add(const ProcessorWatch& watch, const std::string& item, const std::string& quantity, double ours,
                std::optional<double> reference = std::nullopt, const std::string& reference_is = {}) {
    rows.push_back({.item = item,
                    .quantity = quantity,
                    .ours = ours,
                    .reference = reference,
                    .reference_is = reference_is,
                    .processor_seconds = watch.seconds()});
    return rows.back();
  }
};

PaperResults bode(const std::filesystem::path& folder);
PaperResults scabbia2021(const std::filesystem::path& folder);
PaperResults scabbia2023(const std::filesystem::path& folder);
PaperResults scabbia_motion(const std::filesystem::path& folder);

}  // namespace cases
