#include "cases/papers/papers.hpp"

#include <nlohmann/json.hpp>
#include <set>

#include "cases/input/problems.hpp"
#include "post/files/atomic_file.hpp"
#include "tests/catch.hpp"
#include "tests/unit/post/small_run.hpp"

using cases::PaperRow;

TEST_CASE("papers: an unknown name is refused with those that there are, before anything is written") {
  const small_run::TemporaryFolder scratch;
  const auto folder = scratch.path() / "none";
  CHECK_THROWS_WITH(cases::run_papers({.name = "scabia2021", .folder = folder, .quiet = true}),
                    Catch::Contains("scabbia2021, scabbia2023, scabbia_motion") && Catch::Contains("did you mean"));
  CHECK_FALSE(std::filesystem::exists(folder));
}

TEST_CASE("papers: names are distinct, differences are relative, but for references of 0") {
  std::set<std::string> names;
  for (const auto& paper : cases::papers()) CHECK(names.insert(paper.name).second);
  CHECK(cases::papers().size() >= 3);
  CHECK(PaperRow{.ours = 1.1, .reference = 1.0}.difference().value() == Approx(0.1));
  CHECK(PaperRow{.ours = -1.1, .reference = -1.0}.difference().value() == Approx(-0.1));
  CHECK(PaperRow{.ours = 0.3, .reference = 0.0}.difference().value() == 0.3);
  CHECK_FALSE(PaperRow{.ours = 0.3}.difference());
}

TEST_CASE("papers: the examples of 2021 in papers.json have published values, references and claims that hold") {
  const small_run::TemporaryFolder scratch;
  const auto runs = cases::run_papers({.name = "scabbia2021", .folder = scratch.path(), .quiet = true});
  REQUIRE(runs.size() == 1);
  const auto list = nlohmann::json::parse(post::read_text(scratch.path() / "papers.json"));
  REQUIRE(list.size() == runs[0].rows.size());
  int bars = 0, claims = 0, published = 0;
  for (const auto& row : list) {
    CHECK(row["paper"] == "scabbia2021");
    CHECK(row["ours"].is_number());
    CHECK(row["reference"].is_number());
    const std::string item = row["item"], quantity = row["quantity"];
    INFO(item << ": " << quantity);
    const double difference = row["difference"];
    bars += item.starts_with("5.") && quantity.starts_with("u at") && item.find("no corrections") == std::string::npos;
    if (!row["claim"].is_null()) {
      ++claims;
      CHECK(row["claim_holds"] == true);
    }
    if (row["published"].is_number()) {
      ++published;
      CHECK(row["ours"].get<double>() == Approx(row["published"].get<double>()).margin(5e-4));  // as printed
      CHECK(std::abs(difference) < 1e-9);                                                       // measured: 2e-13
    }
    if (item.starts_with("table")) CHECK(std::abs(difference) < 1e-10);  // measured: 4e-14
    if (item.starts_with("5.") && item.find("surface nodes") != std::string::npos && quantity.starts_with("reaction"))
      CHECK(std::abs(difference) < 1e-12);
  }
  CHECK(bars == 32);
  CHECK(claims > 8);
  CHECK(published == 3);
  for (const char* name : {"papers.csv", "report.html", "scabbia2021/report.html", "scabbia2021/curves.svg"})
    CHECK(std::filesystem::exists(scratch.path() / name));
}
