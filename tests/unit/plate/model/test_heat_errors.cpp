#include "plate/model/problem_validation.hpp"

#include "tests/unit/cases/case_text.hpp"

using namespace case_text;

TEST_CASE("temperatures are refused where a plate could not bend freely, all reasons at once") {
  const std::string load = "[[load]]\nkind = \"temperature\"\nvalue = 20\n";
  CHECK(problems(plain + load, {"section.thermal_expansion=1e-5"}).empty());
  expect(plain + load, ":1", "section.thermal_expansion", "is missing");
  const std::vector<std::string> bonds{"section.thermal_expansion=1e-5", "discretization.formulation=ordinary"};
  const auto with = [&](const std::string& more) {
    auto all = bonds;
    all.push_back(more);
    return problems(plain + load, all).size();
  };
  CHECK(problems(plain + load, bonds).empty());
  CHECK(with("discretization.surface_correction=volume") == 1);
  CHECK(with("support[0].kind=clamped_layer") == 1);
  CHECK(problems(plain + load, {"discretization.formulation=ordinary", "discretization.surface_correction=none",
                                "support[0].kind=clamped_layer"})
            .size() == 3);
  expect(plain + "[[load]]\nkind = \"temperature\"\nexpression = \"20 * z\"\n", ":20", "load[1].expression", "\"z\"",
         {"section.thermal_expansion=1e-5"});
  const std::string isotropic = "young = 1000.0\npoisson = 0.3\n";
  std::string turned = plain;
  turned.replace(turned.find(isotropic), isotropic.size(),
                 "thermal_expansion = 1e-5\n"
                 "orthotropic = { E1 = 1000, E2 = 300, nu12 = 0.3, G12 = 150, G13 = 150, G23 = 100 }\n");
  CHECK(problems(turned + load).empty());
  CHECK(problems(turned + "[[load]]\nkind = \"temperature\"\nexpression = \"20 * x\"\n").empty());
  CHECK(problems(turned + "[[load]]\nkind = \"temperature\"\nmean = \"20 * x\"\n").empty());
  expect(plain + load, "--set growth.fracture_energy", "growth", "no account of temperature",
         {"section.thermal_expansion=1e-5", "growth.fracture_energy=1", "section.density=1", "analysis.kind=dynamic",
          "analysis.duration=1"});
}

TEST_CASE("a mean temperature: a number or an expression, alone or beside the difference of the faces") {
  const std::vector<std::string> settings{"section.thermal_expansion=1e-5", "support[0].in_plane=\"fixed\""};
  const std::string load = "[[load]]\nkind = \"temperature\"\n";
  for (const std::string good : {"mean = 20", "mean = -20.5\nvalue = 3", "mean = \"20 * x\"\nexpression = \"y\""}) {
    CAPTURE(good);
    CHECK(problems(plain + load + good, settings).empty());
    const auto once = cases::resolved_toml(read(plain + load + good, settings).content);
    const auto again = read(once).content;
    CHECK(cases::resolved_toml(again) == once);
    CHECK(again.loads[1].in_plane());
  }
  expect(plain + load + "mean = 0\n", ":20", "load[1].mean", "is zero", settings);
  expect(plain + load + "mean = \"20 * z\"\n", ":20", "load[1].mean", "\"z\"", settings);
  expect(plain + load, ":18", "load[1].value", "is missing", settings);
  expect(with_line(plain, 15, "value = 1\nmean = 3"), ":16", "load[0].mean", "kind");
  auto moving = settings;
  for (const char* more :
       {"analysis.kind=dynamic", "analysis.duration=1", "analysis.nonlinear=true", "section.density=1"})
    moving.emplace_back(more);
  expect(plain + load + "mean = 20\n", "--set analysis.nonlinear", "analysis.nonlinear", "not in motion yet", moving);
}
