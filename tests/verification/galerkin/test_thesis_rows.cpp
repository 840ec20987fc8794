// Rows of `pdplate papers bode`: published numbers, references and claims.

#include <cmath>
#include <set>

#include "cases/papers/papers.hpp"
#include "tests/catch.hpp"

namespace {

const cases::PaperResults& thesis() {
  static const cases::PaperResults results = cases::bode({});
  return results;
}

/// Rows whose item and quantity hold these words; fails where there is none.
std::vector<cases::PaperRow> rows_of(const std::string& item, const std::string& quantity) {
  std::vector<cases::PaperRow> found;
  for (const auto& row : thesis().rows)
    if (row.item.find(item) != std::string::npos && row.quantity.find(quantity) != std::string::npos)
      found.push_back(row);
  CAPTURE(item, quantity);
  REQUIRE_FALSE(found.empty());
  return found;
}

void check_rows() {
  std::set<std::pair<std::string, std::string>> pairs;
  for (const auto& row : thesis().rows) {
    INFO(row.item << ": " << row.quantity);
    CHECK(std::isfinite(row.ours));
    CHECK(row.reference.has_value() != row.item.starts_with("7.2.5"));
    CHECK(pairs.insert({row.item, row.quantity}).second);
  }
  CHECK(thesis().panels.size() == 12);
}

void check_claims() {
  std::set<std::string> failed;
  int claims = 0;
  for (const auto& row : thesis().rows) {
    claims += row.claim.has_value();
    if (row.claim && !row.claim->holds) failed.insert(row.item + ": " + row.claim->text);
  }
  CHECK(claims > 80);  // measured: 94
  CHECK(failed == std::set<std::string>{"table 7.2, VCPPG V1sn UnlP0, dilation by Unl: "
                                        "fails the patch test",  // measured: 2e-15
                                        "7.2.3 manufactured field, regular points, VC "
                                        "Unl+P1C: rate 2",  // measured: 1.84
                                        "7.2.3 manufactured field, moved points, VC "
                                        "Unl+P1C: rate 2",  // measured: 1.86
                                        "7.2.5 inf-sup, regular points, Unl+P1C: bounded "
                                        "from below"});  // measured: 0.24, 0.08, 0.04
}

void check_rates() {
  for (const char* name : {"PG-CA", "VC Unl", "VC U1SIG", "VCPPG V3 Unl"}) {
    for (const auto& row : rows_of(std::string("points, ") + name, "rate of the L2")) {
      if (row.item.ends_with("Unl+P1C")) continue;
      CAPTURE(row.item, row.ours);
      CHECK(row.ours > 1.9);                            // measured: 1.93 VCPPG to 2.18 VC U1SIG
      CHECK(std::abs(row.difference().value()) < 0.1);  // measured: 0.072
    }
    for (const auto& row : rows_of(std::string("points, ") + name, "rate of the H1"))
      CHECK(row.ours > 1.05);  // measured: 1.07 PG-CA on moved points to 1.53
  }
  for (const char* name : {", Unl", ", PPG Unl"})
    for (const auto& row : rows_of(std::string("points") + name, "rate of the L2"))
      CHECK(row.ours < 1.3);  // measured: 0.91 to 1.24
}

void check_hole() {
  for (const char* name : {"PG-CA", "VCPPG V3 Unl"})
    for (const auto& row : rows_of(std::string("hole, ") + name, "sigma_xx / tension at the hole"))
      CHECK(std::abs(row.difference().value()) < 0.03);                                 // measured: -2.0, -2.3 %
  for (const auto& row : rows_of("hole, PG-CA", "rms error")) CHECK(row.ours < 0.01);   // measured: 0.0085
  for (const auto& row : rows_of("hole, VC Unl", "rms error")) CHECK(row.ours < 0.05);  // measured: 0.045
  for (const auto& row : rows_of("hole, Unl", "rms error")) CHECK(row.ours > 0.2);      // measured: 0.31
}

}  // namespace

// one test case: ctest would compute all of it for each
TEST_CASE(
    "examples of the Galerkin thesis: rows, claims, rates of "
    "convergence, stresses at a hole") {
  check_rows();
  check_claims();
  check_rates();
  check_hole();
}
