#include "plate/solve/validation.hpp"

#include "plate/formulation/discretised.hpp"
#include "tests/unit/cases/case_text.hpp"

using namespace case_text;
using plate::Subject;

namespace {

std::vector<Subject> refused(std::vector<std::string> settings) {
  settings.emplace_back("discretization.spacing=0.1");
  const auto c = read(plain, settings).content;
  std::vector<Subject> subjects;
  for (const auto& one : plate::validate(*plate::discretise(c).plate, c.analysis).refusals)
    subjects.push_back(one.subject);
  return subjects;
}

std::vector<Subject> errors(const std::vector<std::string>& settings, double spacing) {
  auto c = read(with_line(plain, 17, "kind = \"dynamic\"\nduration = 1"), settings).content;
  c.discretization.spacing = spacing;
  std::vector<Subject> subjects;
  for (const auto& one : plate::errors_in_lengths(c, c.analysis)) subjects.push_back(one.subject);
  return subjects;
}

}  // namespace

TEST_CASE("suitability: a plate that its analysis cannot have is refused for what stands in the way") {
  CHECK(refused({}).empty());
  CHECK(refused({"support=[]"}) == std::vector{Subject::support});
  const std::vector<std::string> modes{"analysis={kind=\"frequencies\"}", "section.density=1", "-load"};
  CHECK(refused(modes).empty());
  auto many = modes;
  many.emplace_back("analysis.modes=1000");  // of 400 points
  CHECK(refused(many) == std::vector{Subject::modes});
}

TEST_CASE("suitability: temperatures that strain a plate beyond small strains are told") {
  const auto told = [](const std::string& expansion, const std::string& load) {
    const auto c = read(plain, {"discretization.spacing=0.1", "section.thermal_expansion=" + expansion, load}).content;
    const auto warnings = plate::validate(*plate::discretise(c).plate, c.analysis).warnings;
    return std::ranges::count_if(warnings,
                                 [](const auto& one) { return one.find("beyond small strains") != one.npos; });
  };
  CHECK(told("12e-6", "load=[{kind=\"temperature\", value=40}]") == 0);
  CHECK(told("12", "load=[{kind=\"temperature\", value=40}]") == 1);
  CHECK(told("12", "load=[{kind=\"temperature\", value=0, mean=40}]") == 1);
}

TEST_CASE("suitability: load cases and combinations that are hot are told by their names") {
  const auto told = [](const std::string& factor) {
    const auto c = read(plain, {"discretization.spacing=0.1", "section.thermal_expansion=1e-5", "-load",
                                "case=[{name=\"sun\", load=[{kind=\"temperature\", value=0, mean=4000}]}, "
                                "{name=\"fire\", load=[{kind=\"temperature\", value=1000, mean=-500}]}]",
                                "combination=[{name=\"both\", of={sun=1, fire=" + factor + "}}]"})
                       .content;
    for (const auto& warning : plate::validate(*plate::discretise(c).plate, c.analysis).warnings)
      if (warning.find("beyond small strains") != std::string::npos) return warning;
    return std::string();
  };
  CHECK(told("1").empty());                                                           // 0.035 + 0.005
  CHECK_THAT(told("-1.2"), Catch::Contains("by 0.052 in combination both, beyond"));  // 0.046 + 0.006
  CHECK_THAT(told("12"), Catch::Contains("by 0.08 in combination both"));
  CHECK_THAT(told("-2"), Catch::Contains("by 0.06 in combination both"));
}

TEST_CASE("suitability: four cells across, and enough thickness for single precision") {
  const std::vector<std::string> moving{"section.density=1", "discretization.formulation=ordinary"};
  CHECK(errors(moving, 0.5).empty());
  CHECK(errors(moving, 0.51) == std::vector{Subject::spacing});
  auto mixed = moving;
  mixed.emplace_back("analysis.precision=mixed");
  CHECK(errors(mixed, 0.05).empty());                             // 2^-24 (2 / 0.05) (2 / 0.1)^2 = 1e-3
  CHECK(errors(mixed, 1e-4) == std::vector{Subject::precision});  // 0.48, above 0.3
}
