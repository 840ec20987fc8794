// Intensity factors of a case: tips without room, outlines that bonds do not follow.
#include <set>

#include "cases/driver/run.hpp"
#include "post/files/summary.hpp"
#include "tests/unit/cases/case_text.hpp"
#include "tests/unit/post/small_run.hpp"

using case_text::plain;

namespace {

const std::string by_energy = "srif.methods=[\"domain_integral\"]";
const std::string cracked = plain + "[srif]\n[output]\nfields = []\n";
const std::string lattice = "discretization.refine_tips=false";

std::set<std::size_t> tips_with_factors(const post::Summary& summary) {
  std::set<std::size_t> result;
  for (const auto& srif : summary.srif) result.insert(srif.tip);
  return result;
}

}  // namespace

TEST_CASE("factors: a tip without room has none and a warning, the others have theirs") {
  const small_run::TemporaryFolder folder;
  const auto summary = cases::run(
      case_text::read(cracked,
                      {"geometry.cracks=[[[-0.3, 0.0], [0.3, 0.0]], [[0.6, 0.5], [0.95, 0.5]]]", by_energy, lattice}),
      {folder.path(), true});
  CHECK(tips_with_factors(summary) == std::set<std::size_t>{0, 1, 2});
  CHECK(std::ranges::count_if(summary.warnings, [](const auto& text) {
          return text.starts_with("tip at (0.95, 0.5): no intensity factors: ");
        }) == 1);

  const auto of_ligament = [](const auto& text) {
    return text.find("errors may exceed their estimates") != std::string::npos;
  };
  CHECK(std::ranges::count_if(summary.warnings, of_ligament) == 1);
  const auto wider = cases::run(
      case_text::read(cracked,
                      {"geometry.cracks=[[[-0.3, 0.0], [0.3, 0.0]], [[0.6, 0.5], [0.85, 0.5]]]", by_energy, lattice}),
      {folder.path(), true});
  CHECK(std::ranges::none_of(wider.warnings, of_ligament));

  const auto all_near = case_text::read(cracked, {"geometry.cracks=[[[-0.96, 0.5], [0.95, 0.5]]]", by_energy, lattice});
  CHECK_THROWS_WITH(cases::run(all_near, {folder / "refused", true}),
                    Catch::Contains("tip at (-0.96, 0.5)") && Catch::Contains("tip at (0.95, 0.5)"));
  CHECK_FALSE(std::filesystem::exists(folder / "refused"));
}

TEST_CASE("factors: bonds say that edges oblique to the lattice are stairs for them, and their errors hold it") {
  const auto run = [](const std::string& outline, const std::string& formulation) {
    const small_run::TemporaryFolder folder;
    return cases::run(
        case_text::read(cracked, {"geometry.outline=" + outline, "discretization.formulation=" + formulation,
                                  "discretization.spacing=0.025"}),
        {folder.path(), true});
  };
  const std::string square = "{ rectangle = [-1.0, -1.0, 1.0, 1.0] }";
  const std::string skew =
      "{ polygon = [[-1.0, -1.0], [1.0, -0.9], [1.0, 1.0], [-1.0, 1.0]], edges = [\"bottom\", \"right\", \"top\", "
      "\"left\"] }";
  const auto stairs = [](const post::Summary& summary) {
    return std::ranges::any_of(summary.warnings,
                               [](const auto& text) { return text.find("stairs") != std::string::npos; });
  };
  const auto of_square = run(square, "ordinary"), of_skew = run(skew, "ordinary");
  CHECK_FALSE(stairs(of_square));
  CHECK(stairs(of_skew));
  CHECK_FALSE(stairs(run(skew, "galerkin")));
  const double added = 2.25 * 0.025 / 2;
  CHECK(*of_skew.srif[0].estimated_error > *of_square.srif[0].estimated_error + 0.5 * added);
}
