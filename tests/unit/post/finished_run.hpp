#pragma once
#include <cmath>

#include "post/files/factor_rows.hpp"
#include "post/files/summary.hpp"
#include "post/report/quantity.hpp"
#include "tests/unit/post/small_run.hpp"

/// The summary and the tables of a run that has ended.
namespace finished_run {

using small_run::TemporaryFolder;

/// Two tips, the first by two methods, with K1 doubled at time 1 in srif.csv alone; two rows of a probe named like a
/// number, and two rows of history.
struct FinishedRun {
  TemporaryFolder folder;
  post::Summary summary;

  FinishedRun() {
    post::Srif first, other_method, second;
    first.method = second.method = post::SrifMethod::domain_integral;
    other_method.method = post::SrifMethod::series_fit;
    first.K1 = 0.5;
    first.F1 = 0.25;
    other_method.K1 = 99;
    second.tip = 1;
    second.K3 = -2;
    second.F3 = NAN;
    summary.srif = {first, other_method, second};
    summary.points = 400;
    summary.analysis.steps = 17;
    summary.seconds = {{"solve", 0.5}, {"output", 1}, {"total", 2}};
    post::write_csv(folder / "probes.csv",
                    {{"time", "probe", "w", "theta_x"},
                     {{0.0, "7", 1.0, 2.0}, {0.0, "b", 3.0, 4.0}, {1.0, "7", 5.0, 6.0}, {1.0, "b", 7.0, INFINITY}}});
    post::write_csv(folder / "history.csv", {{"time", "strain_energy"}, {{0.0, 0.0}, {1.0, 11.0}}});
    post::Table srifs;
    post::append(srifs, 0, {first, other_method, second});
    for (auto& srif : summary.srif) srif.K1 *= 2;
    post::append(srifs, 1, summary.srif);
    for (auto& srif : summary.srif) srif.K1 /= 2;
    post::write_csv(folder / "srif.csv", srifs);
  }
  std::optional<double> value(const post::Quantity& quantity) const {
    return post::value(quantity, summary, folder.path());
  }
};

}  // namespace finished_run
