// Reactions in time, through the program: what supports do is what loads and inertia ask for, at every row.
#include <nlohmann/json.hpp>

#include <map>

#include "cases/driver/run.hpp"
#include "post/files/summary.hpp"
#include "post/files/table.hpp"
#include "tests/unit/cases/case_text.hpp"
#include "tests/unit/post/small_run.hpp"

using case_text::plain;

namespace {

std::string loaded_motion(const std::string& more) {
  std::string text = plain;
  text.replace(text.find("kind = \"static\""), 15, "kind = \"dynamic\"\nduration = 0.3");
  text.insert(text.find("thickness"), "density = 1.0\n");
  return text + "[output]\nfields = []\n" + more;
}

double number(const post::Cell& cell) {
  return std::get<double>(cell);
}

/// Force by name of every time.
std::map<double, std::map<std::string, double>> forces(const post::Table& table) {
  std::map<double, std::map<std::string, double>> result;
  for (const auto& row : table.rows)
    result[number(row[table.column("time")])][std::get<std::string>(row[table.column("support")])] =
        number(row[table.column("force")]);
  return result;
}

/// Of the load: straight lines between its turns.
double history(double time) {
  const std::vector<std::pair<double, double>> turns{{0, 0}, {0.04, 1}, {0.11, -1}, {0.18, 1}, {0.25, -1}, {0.4, 0}};
  std::size_t i = 1;
  while (i + 1 < turns.size() && turns[i].first < time) ++i;
  const auto& [t0, f0] = turns[i - 1];
  const auto& [t1, f1] = turns[i];
  return f0 + (f1 - f0) * (time - t0) / (t1 - t0);
}

double largest(const post::Table& table, const std::string& column) {
  double result = 0;
  for (const auto& row : table.rows) result = std::max(result, std::abs(number(row[table.column(column)])));
  return result;
}

}  // namespace

TEST_CASE("reactions of a motion: by steps of both formulations and in mixed precision they balance at every row") {
  const small_run::TemporaryFolder folder;
  for (const auto& [setting, most] :
       {std::pair{"discretization.formulation=galerkin", 1e-10},
        std::pair{"discretization.formulation=ordinary", 1e-10}, std::pair{"analysis.precision=mixed", 1e-3}})
    for (const std::string kind : {"clamped", "simply_supported", "simply_supported_hard"}) {
      CAPTURE(setting, kind);
      const auto summary = cases::run(
          case_text::read(loaded_motion(""), {setting, "discretization.spacing=0.1",
                                              "load[0].history=[[0,0],[0.04,1],[0.11,-1],[0.18,1],[0.25,-1],[0.4,0]]",
                                              "support=[{kind=\"" + kind + "\",edges=[\"left\",\"bottom\"]}]"}),
          {folder / "run", true});
      const auto table = post::read_csv(folder / "run" / "reactions.csv");
      CHECK(largest(table, "residual") < most);
      const auto rows = forces(table);
      CHECK(rows.size() == post::read_csv(folder / "run" / "history.csv").rows.size());
      double scale = 0, worst = 0;
      for (const auto& [time, row] : rows) {
        CHECK(row.at("loads") == Approx(4 * history(time)).margin(1e-9));
        scale = std::max(scale, std::abs(row.at("left")));
        worst = std::max(worst, std::abs(row.at("left") + row.at("bottom") + row.at("loads") - row.at("inertia")));
      }
      CHECK(worst < 2 * most * scale);
      const auto& reactions = *summary.reactions;
      CHECK(reactions.time == Approx(0.3));
      CHECK(std::abs(reactions.largest[0].force) == Approx(scale));
      CHECK(rows.at(reactions.largest[0].time).at("left") == Approx(reactions.largest[0].force));
    }
}

TEST_CASE("reactions of a motion by Lanczos vectors are those of steps") {
  const small_run::TemporaryFolder folder;
  const std::vector<std::string> shared{"output.history_every=0.01", "discretization.spacing=0.05",
                                        "load[0].history=[[0,0],[0.2,1]]"};
  std::vector<std::map<double, std::map<std::string, double>>> found;
  for (const char* method : {"analysis.method=central_difference", "analysis.method=lanczos"}) {
    auto settings = shared;
    settings.push_back(method);
    cases::run(case_text::read(loaded_motion(""), settings), {folder / "run", true});
    const auto table = post::read_csv(folder / "run" / "reactions.csv");
    CHECK(largest(table, "residual") < 0.01);
    found.push_back(forces(table));
  }
  double scale = 0, difference = 0;
  for (const auto& [time, row] : found[0]) scale = std::max(scale, std::abs(row.at("left")));
  REQUIRE(found[0].size() == found[1].size());
  auto other = found[1].begin();
  for (const auto& [time, row] : found[0]) {
    difference = std::max(difference, std::abs(row.at("left") - other->second.at("left")));
    ++other;
  }
  CHECK(scale > 1);  // measured: 1.36
  CHECK(difference < 0.03 * scale);
}

TEST_CASE("reactions of a quasi-static growth balance at every advance, of tips and of bonds") {
  const small_run::TemporaryFolder folder;
  const std::string text = plain + "[output]\nfields = []\n[growth]\nfracture_energy = 1e-4\nmax_advances = 4\n";
  for (const auto& [settings, most] :
       {std::pair{std::vector<std::string>{"growth.criterion=energy_release", "discretization.formulation=galerkin"},
                  1e-5},
        std::pair{std::vector<std::string>{"growth.criterion=energy_release", "discretization.formulation=ordinary"},
                  1e-5},
        std::pair{std::vector<std::string>{"growth.criterion=bond_energy", "discretization.formulation=ordinary"},
                  1e-5}}) {
    auto all = settings;
    all.push_back("support=[{kind=\"clamped\",edges=[\"bottom\",\"top\"]}]");
    CAPTURE(settings);
    const auto summary = cases::run(case_text::read(text, all), {folder / "run", true});
    const auto table = post::read_csv(folder / "run" / "reactions.csv"),
               history = post::read_csv(folder / "run" / "history.csv");
    CHECK(largest(table, "residual") < most);
    const auto rows = forces(table);
    REQUIRE(rows.size() == history.rows.size());
    CHECK(rows.size() > 2);
    for (const auto& row : history.rows) {
      const auto& here = rows.at(number(row[history.column("time")]));
      const double load = 4 * number(row[history.column("load_factor")]);
      CHECK(here.at("loads") == Approx(load));
      CHECK(here.at("bottom") + here.at("top") == Approx(-load).epsilon(1e-4));
    }
    CHECK(summary.reactions->time == number(history.rows.back()[history.column("time")]));
  }
}

TEST_CASE(
    "reactions in summary.json, factors at the faces, extremes, nothing of them with frequencies or free plates") {
  const small_run::TemporaryFolder folder;
  const auto json_of = [&](const std::string& text, const std::vector<std::string>& settings) {
    cases::run(case_text::read(text, settings), {folder / "run", true});
    return nlohmann::json::parse(small_run::text_of(folder / "run" / "summary.json"));
  };
  const auto still = json_of(plain + "[srif]\ntoughness = 40.0\n[output]\nfields = []\n", {"units=SI"});
  CHECK(still["reactions"]["supports"][0]["support"] == "left");
  CHECK(still["reactions"]["supports"][0]["force"].get<double>() == Approx(-4).epsilon(1e-4));
  CHECK(still["reactions"]["residual"].get<double>() < 1e-4);
  CHECK_FALSE(still["reactions"].contains("time"));
  CHECK(still["toughness"] == 40);
  for (const auto& entry : still["srif"]) {
    CHECK(entry["faces"]["K_eq"].get<double>() / 40 == Approx(entry["faces"]["utilisation"].get<double>()));
    if (!entry["K1"].is_null())
      CHECK(entry["faces"]["K_I"].get<double>() == Approx(std::sqrt(M_PI) * 600 * entry["K1"].get<double>()));
  }
  CHECK(still["extremes"][0]["quantity"] == "w");
  CHECK(still["extremes"][0]["x"].get<double>() > 0.9);
  CHECK(still["extremes"][1]["outside"].get<double>() == Approx(0.05));  // half a thickness: points are fine at tips
  CHECK(still["sanity"]["deflection_over_thickness"].get<double>() * 0.1 ==
        Approx(still["extremes"][0]["value"].get<double>()));

  const auto free = json_of(loaded_motion(""), {"support=[]", "discretization.spacing=0.1"});
  CHECK_FALSE(free.contains("reactions"));
  CHECK(free["peaks"].back()["quantity"] == "von_mises");
  CHECK_FALSE(std::filesystem::exists(folder / "run" / "reactions.csv"));
  std::string text = plain.substr(0, plain.find("[[load]]")) + "[analysis]\nkind = \"frequencies\"\n";
  text.insert(text.find("thickness"), "density = 1.0\n");
  const auto modes = json_of(text, {"discretization.spacing=0.2", "output.fields=[]"});
  for (const char* name : {"reactions", "extremes", "peaks", "sanity"}) CHECK_FALSE(modes.contains(name));
}

TEST_CASE("a toughness is a positive number, of cases with loads") {
  const std::string text = plain + "[srif]\ntoughness = 0\n";
  case_text::expect(text, ":19", "srif.toughness", "> 0");
  case_text::expect(plain + "[srif]\ntoughness = \"steel\"\n", ":19", "srif.toughness", "number");
}
