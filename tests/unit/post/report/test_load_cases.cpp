// The largest of all load cases, and how load cases are printed.
#include "post/report/printed.hpp"

#include "plate/model/section.hpp"
#include "post/files/factor_rows.hpp"
#include "post/files/summary.hpp"
#include "post/files/table.hpp"
#include "tests/catch.hpp"

using namespace post;

namespace {

Srif case_factors(std::size_t tip, double K1, double K2, double G, SrifMethod method = SrifMethod::domain_integral) {
  Srif srif;
  srif.tip = tip, srif.K1 = K1, srif.K2 = K2, srif.G = G, srif.method = method;
  srif.errors = {0.5, 0.25, 0.125};
  return srif;
}

std::vector<LoadCaseSummary> two() {
  LoadCaseSummary dead{"dead"}, uls{"uls", {{"dead", 1.35}}};
  dead.srif = {case_factors(0, 2, -1, 5), case_factors(0, 99, 99, 99, SrifMethod::series_fit),
               case_factors(1, 1, 0, 1)};
  uls.srif = {case_factors(0, -3, 0.5, 4), case_factors(1, 7, 4, 2)};
  uls.srif[1].resolved[1] = false;
  return {dead, uls};
}

const plate::Section section{1000, 0.3, 0.1, 5.0 / 6, 2};

const EnvelopeEntry& entry(const std::vector<EnvelopeEntry>& all, std::size_t tip, const std::string& quantity) {
  for (const auto& one : all)
    if (one.tip == tip && one.quantity == quantity) return one;
  throw std::out_of_range(quantity);
}

}  // namespace

TEST_CASE("envelope: the largest by recommended methods, with its sign and what gives it") {
  const auto all = envelope(two(), section, {});
  CHECK(all.size() == 10);
  CHECK(entry(all, 0, "K1").value == -3);
  CHECK(entry(all, 0, "K1").of == "uls");
  CHECK(entry(all, 0, "K1").error == 0.5);
  CHECK(entry(all, 0, "K2").value == -1);
  CHECK(entry(all, 0, "K2").of == "dead");
  CHECK(entry(all, 0, "G").value == 5);
  CHECK(entry(all, 1, "K1").of == "uls");
  CHECK(entry(all, 1, "K2").of == "dead");   // not resolved in the other
  CHECK(entry(all, 1, "K2").error == 4.25);  // where it may be 4 + 0.25
  const auto faces = at_faces(two()[1].srif[0], section, {});
  CHECK(entry(all, 0, "K_eq").value == faces.equivalent);
  CHECK(entry(all, 0, "K_eq").error == faces.error);
  CHECK(entry(all, 0, "K_eq").of == "uls");
  const auto table = envelope_table(all);
  CHECK(table.rows.size() == 10);
  CHECK(table.rows[0][table.column("case")] == Cell("uls"));
  CHECK(envelope({}, section, {}).empty());
}

TEST_CASE("envelope: factors in the plane, and utilisations where there is a toughness") {
  auto cases = two();
  for (auto& one : cases)
    for (auto& srif : one.srif) srif.membrane = MembraneFactors{{1, -2}, {0.1, 0.2}, {true, true}, {}, 0.1};
  cases[1].srif[0].membrane->N[0] = -5;
  cases[1].srif[1].membrane->resolved[1] = false, cases[1].srif[1].membrane->N[1] = 4;
  const auto all = envelope(cases, section, 3000);
  CHECK(all.size() == 16);
  CHECK(entry(all, 0, "N1").value == -5);
  CHECK(entry(all, 0, "N1").error == 0.1);
  CHECK(entry(all, 0, "N1").of == "uls");
  CHECK(entry(all, 1, "N2").of == "dead");
  CHECK(entry(all, 1, "N2").error.value() == Approx(2.2));  // where it may be 4 + 0.2
  const auto used = at_faces(cases[1].srif[0], section, 3000);
  CHECK(entry(all, 0, "utilisation").value == used.utilisation);
  CHECK(entry(all, 0, "utilisation").error == used.utilisation_error);
}

TEST_CASE("envelope: utilisations come first, the largest of all tips before others") {
  const auto all = envelope(two(), section, 3000);  // tip 1 is loaded more than tip 0
  REQUIRE(all.size() == 12);
  CHECK(all[0].quantity == "utilisation");
  CHECK(all[0].tip == 1);
  CHECK(all[1].quantity == "utilisation");
  CHECK(all[1].tip == 0);
  CHECK(all[0].value > all[1].value);
  CHECK(entry(all, 1, "K_eq").value == Approx(3000 * all[0].value));
  const auto table = envelope_table(all);
  CHECK(table.rows[0][table.column("quantity")] == Cell("utilisation"));
  CHECK(table.rows[0][table.column("tip")] == Cell(1.0));
}

TEST_CASE("envelope: where a load case resolves no factor, K_eq and utilisation may be larger by what these may be") {
  auto cases = two();
  for (auto& one : cases) one.srif.resize(1);
  cases[1].srif[0].K1 = -30, cases[1].srif[0].resolved = {false, false, false};
  const auto all = envelope(cases, section, 3000);
  const auto& used = entry(all, 0, "utilisation");
  CHECK(used.of == "dead");
  const auto most = at_faces(as_resolved(cases[1].srif[0]), section, 3000);
  CHECK(used.value + used.error.value() == Approx(*most.utilisation + *most.utilisation_error));
  const auto& equivalent = entry(all, 0, "K_eq");
  CHECK(equivalent.value + equivalent.error.value() == Approx(*most.equivalent + *most.error));
}

TEST_CASE("load cases: tables get their names by the number in the place of time") {
  const auto cases = two();
  Table table{srif_columns(), {}};
  append(table, 1, cases[0].srif), append(table, 2, cases[1].srif);
  name_cases(table, cases);
  REQUIRE(table.rows.size() == 5);
  CHECK(table.columns.back() == "case");
  CHECK(table.rows[2].back() == Cell("dead"));
  CHECK(table.rows[3].back() == Cell("uls"));
}

TEST_CASE("load cases: a row for each and tip, the envelope, reactions and deflections") {
  Summary summary;
  summary.load_cases = two();
  summary.load_cases[0].extremes = {{"w", {}, -0.5, 1, geometry::Point(1, 2), {}}};
  ReactionSummary reactions{{{"left", {}}}, 1, {{{-3, 0, 0}}, {3, 0, 0}, {}, 1e-9}, 0, {}};
  summary.load_cases[0].reactions = reactions;
  summary.envelope = envelope(summary.load_cases, section, {});
  const auto text = printed_load_cases(summary, false, 0.1);
  CHECK_THAT(text, Catch::Contains("case  tip") && Catch::Contains("dead    0             2            -1"));
  CHECK_THAT(text, Catch::Contains("uls     0            -3           0.5"));
  CHECK_THAT(text, Catch::Contains("   0 K1              -3 +- 0.5       uls"));
  CHECK_THAT(text, Catch::Contains("   1 K2               - +- 4.2       not resolved in all"));
  CHECK_THAT(text, Catch::Contains("   0 K1 ") && Catch::Contains("   0 K_eq "));
  CHECK_THAT(text, !Catch::Contains("99"));
  CHECK_THAT(text, Catch::Contains("reactions along w, dead: left -3; loads 3; balanced to 1.0e-09"));
  CHECK_THAT(text, Catch::Contains("largest |w|, dead: -0.5 at (1, 2)"));
}

TEST_CASE("load cases: factors in the plane and utilisations have tables of their own") {
  Summary summary;
  summary.load_cases = two();
  for (auto& one : summary.load_cases)
    for (auto& srif : one.srif) {
      srif.membrane = MembraneFactors{{1.5, 0}, {0.15, 0}, {true, true}, {}, 0.1};
      one.faces.push_back(at_faces(srif, section, 3000));
    }
  summary.envelope = envelope(summary.load_cases, section, 3000);
  const auto text = printed_load_cases(summary, false, 0.1);
  CHECK_THAT(text, Catch::Contains("in the plane:\ncase  tip            N1            N2    error\n"
                                   "dead    0           1.5             0     10 %\n"));
  CHECK_THAT(text, Catch::Contains("at the faces:\ncase  tip                   K_eq       of toughness\ndead    0 ") ||
                       Catch::Contains("at the faces:\ncase  tip                   K_eq\ndead    0 "));
  CHECK(text.find("utilisation") < text.find("K1"));  // what governs comes first
  CHECK_THAT(text, Catch::Contains("   0 N1                    1.5 +- 0.15"));
  CHECK_THAT(text, !Catch::Contains("   0 N2"));
}
