#include "post/factors/errors.hpp"

#include "post/factors/plate_factors.hpp"
#include "tests/catch.hpp"

using namespace post;

namespace {

const plate::Section unit_section{1000, 0.3, 0.1, 5.0 / 6, 1};
const ErrorShares shares{0.3, 0, 1, 1, 0.001, 0.04, 0.25, 0.05};

Srif by_energy(SrifMethod method, double K1, double K2, double K3, double factor = 1) {
  Srif result;
  result.method = method;
  result.K1 = K1, result.K2 = K2, result.K3 = K3;
  result.G = factor * TipSection(unit_section).unit_release().dot(Eigen::Vector3d(K1, K2, K3).cwiseAbs2());
  return result;
}

/// With their estimates, and marked.
std::vector<Srif> estimated(std::vector<Srif> found, const std::vector<FitSrif>& fits,
                            std::vector<double> largest = {}) {
  estimate_errors(found, fits, unit_section, shares);
  mark_lost(found, unit_section.thickness, largest);
  return found;
}

}  // namespace

TEST_CASE("where all methods agree the errors are the least ones") {
  const std::vector<FitSrif> fits{{1, 4, 1, 0.2, 3}, {1, 3, 1, 0.2, 3}};
  const auto found = estimated(
      {by_energy(SrifMethod::domain_integral, 1, 0.2, 3), by_energy(SrifMethod::virtual_crack_extension, 1, 0.2, 3)},
      fits);
  const double e3 = (0.001 + 0.04 / 64) / 0.1;
  const Eigen::Vector3d unit = TipSection(unit_section).unit_release();
  for (const auto& srif : found) {
    const double taken = unit[2] / unit[0] * 3 * e3 / (1 + 0.04);  // of G by the error of K3
    CHECK(*srif.errors[0] == Approx(0.001 + taken));
    CHECK(*srif.errors[1] == Approx(0.001 + 0.2 * taken));
    CHECK(*srif.errors[2] == Approx(e3));
    CHECK(*srif.estimated_error == Approx(0.001 + 0.04 / 64));
    CHECK(srif.resolved == std::array{true, true, true});
  }
}

TEST_CASE("every sign of an error enters the factors that it concerns") {
  const std::vector<FitSrif> same{{1, 4, 1, 0, 0}, {1, 3, 1, 0, 0}};
  // a turn of 0.05 between fits is an error of K2, not of K1
  const auto turned =
      estimated({by_energy(SrifMethod::domain_integral, 1, 0, 0)}, {{1, 4, 1, 0, 0}, {1, 3, 1, 0.05, 0}}).front();
  CHECK(*turned.errors[0] < 0.002);
  CHECK(*turned.errors[1] == Approx(0.051).epsilon(0.02));
  // integrals that differ by 2 % in the energy: 1.6 times 1 % of K1
  const auto apart = estimated({by_energy(SrifMethod::virtual_crack_extension, 1, 0, 0),
                                by_energy(SrifMethod::domain_integral, 1, 0, 0, 1.02)},
                               same)
                         .front();
  CHECK(*apart.errors[0] == Approx(0.0169).epsilon(0.02));
  CHECK(*apart.errors[1] < 0.002);
  // fits whose K3 h differ by a fifth of K1: not resolved, K1 and K2 are
  const auto lost =
      estimated({by_energy(SrifMethod::virtual_crack_extension, 1, 0, 0)}, {{1, 4, 1, 0, 0}, {1, 3, 1, 0, 2}}).front();
  CHECK(lost.resolved == std::array{true, true, false});
}

TEST_CASE("without a fit K2 and K3 are not resolved") {
  const auto found = estimated({by_energy(SrifMethod::virtual_crack_extension, 1, 0, 0),
                                by_energy(SrifMethod::domain_integral, 1, 0, 0)},
                               {})
                         .front();
  CHECK(found.resolved == std::array{true, false, false});
}

TEST_CASE("without a fit K1 is given where the whole energy is its own, and not where others may have a part of it") {
  const double h = unit_section.thickness;
  const auto of = [&](double K3) {
    return estimated({by_energy(SrifMethod::virtual_crack_extension, 1, 0, K3 / h),
                      by_energy(SrifMethod::domain_integral, 1, 0, K3 / h)},
                     {})
        .front();
  };
  CHECK(of(0.5).resolved[0]);  // the whole energy would give K1 1.6 % more
  CHECK(*of(3).errors[0] > 2 * (std::sqrt(*of(3).G / TipSection(unit_section).unit_release()[0]) - 1));
  CHECK_FALSE(of(3).resolved[0]);
}

TEST_CASE("an integral that is not positive contradicts the others: nothing is resolved, with a fit or without") {
  for (const double energy : {0.0, -0.5}) {
    Srif contrary = by_energy(SrifMethod::domain_integral, 0, 0, 0);
    contrary.G = energy * TipSection(unit_section).unit_release()[0];
    for (const auto& fits : {std::vector<FitSrif>{}, std::vector<FitSrif>{{1, 4, 1, 0.2, 3}, {1, 3, 1, 0.2, 3}}}) {
      const auto found = estimated({by_energy(SrifMethod::virtual_crack_extension, 1, 0.2, 3), contrary}, fits);
      CHECK(*found.front().errors[0] > 0.9);
      CHECK_FALSE(found.front().resolved[0]);
    }
  }
}

TEST_CASE("one energy release rate alone, without a fit, resolves nothing") {
  const auto alone = estimated({by_energy(SrifMethod::virtual_crack_extension, 1, 0, 0)}, {}).front();
  REQUIRE(alone.errors[0]);
  CHECK(*alone.errors[0] > 1);
  CHECK(alone.resolved == std::array{false, false, false});
}

TEST_CASE("K3 counts as lost from the share on that its formulation sets") {
  ErrorShares strict = shares;
  strict.lost = 0.045;
  std::vector<Srif> found{by_energy(SrifMethod::domain_integral, 1, 0, 0)};
  const std::vector<FitSrif> fits{{1, 4, 1, 0, 0}, {1, 3, 1, 0, 0.6}};  // K3 h differs by 6 %
  CHECK(estimated(found, fits).front().resolved[2]);
  std::vector<double> largest;
  estimate_errors(found, fits, unit_section, strict);
  mark_lost(found, unit_section.thickness, largest);
  CHECK(found.front().resolved == std::array{true, true, false});
}

TEST_CASE("bonds: a share of K3 itself and a turn of K1 and K2 are added to the errors, by energy and by the fit") {
  const std::vector<FitSrif> fits{{1, 4, 1, 0.2, 3}, {1, 3, 1, 0.2, 3}};
  const auto errors = [&](const ErrorShares& some, SrifMethod method) {
    Srif srif = by_energy(SrifMethod::domain_integral, 1, 0.2, 3);
    srif.method = method;
    if (method == SrifMethod::series_fit) srif.G.reset();
    std::vector<Srif> found{srif};
    estimate_errors(found, fits, unit_section, some);
    return found.front().errors;
  };
  for (const auto method : {SrifMethod::domain_integral, SrifMethod::series_fit}) {
    ErrorShares bonds = shares;
    bonds.own_shear = 0.08;
    const auto before = errors(shares, method), sheared = errors(bonds, method);
    CHECK(*sheared[2] - *before[2] == Approx(0.08 * 3));
    bonds.own_shear = 0, bonds.turn = 0.02;
    const auto turned = errors(bonds, method);
    CHECK(*turned[0] - *before[0] == Approx(0.02 * 0.2));
    CHECK(*turned[1] - *before[1] == Approx(0.02));
    CHECK(*turned[2] == Approx(*before[2]));
  }
}

TEST_CASE("points on the faces that are wider apart than the layer make K3 uncertain, the wider the more") {
  const std::vector<FitSrif> fits{{1, 4, 1, 0.2, 3}, {1, 3, 1, 0.2, 3}};
  double before = 0;
  for (const double faces : {0.0, 0.3, 1.0, 3.0}) {
    ErrorShares graded = shares;
    graded.faces = faces, graded.own_shear = 0.0037;
    std::vector<Srif> found{by_energy(SrifMethod::domain_integral, 1, 0.2, 3)};
    estimate_errors(found, fits, unit_section, graded);
    CHECK(*found.front().errors[2] > before);
    before = *found.front().errors[2];
  }
}

TEST_CASE("an energy release rate that is not positive gives no factors, unless others of its tip were far larger") {
  Srif none = by_energy(SrifMethod::virtual_crack_extension, 0, 0, 0);
  none.G = -1e-4 * TipSection(unit_section).unit_release()[0];  // as K1 = 0.01
  const std::vector<FitSrif> fits{{1, 4, 0.3, 0, 0}, {1, 3, 0.3, 0, 0}};
  CHECK(estimated({none, by_energy(SrifMethod::domain_integral, 0.3, 0, 0)}, fits).front().resolved ==
        std::array{false, false, false});
  CHECK(estimated({none}, {{1, 4, 0, 0, 0}, {1, 3, 0, 0, 0}}, {1.0}).front().resolved == std::array{true, true, true});
  CHECK(estimated({none}, {{1, 4, 0, 0, 0}, {1, 3, 0, 0, 0}}, {0.05}).front().resolved ==
        std::array{false, false, false});
}

TEST_CASE("a tip that others shield knows its factors no better than the field of the plate is known") {
  const std::vector<FitSrif> fits{{1, 4, 1, 0.2, 3}, {1, 3, 1, 0.2, 3}};
  std::vector<Srif> all = estimated({by_energy(SrifMethod::domain_integral, 1, 0.2, 3)}, fits);
  all.push_back(all.front());
  all.back().K1 *= 0.01, all.back().K2 *= 0.01, all.back().K3 *= 0.01, all.back().tip = 1;
  const auto before = all;
  const double most = largest_of_tips(all, unit_section.thickness);
  CHECK(most == 1);
  add_errors_of_other_tips(all, most, unit_section.thickness);
  CHECK(all.front().errors == before.front().errors);
  CHECK(*all.back().errors[1] - *before.back().errors[1] == Approx(0.0007 * 0.99));
  CHECK(*all.back().errors[2] - *before.back().errors[2] == Approx(0.0007 * 0.99 / unit_section.thickness));
}

TEST_CASE("a factor that is small beside those of the other part is resolved as far as a face's stress needs") {
  const double h = unit_section.thickness;
  const auto in_plane = [&](double N1, double error) {
    Srif srif;
    srif.K1 = 1, srif.errors = {0.01, 0.01, 0.01};
    srif.membrane = MembraneFactors{{N1, 0}, {error, error}, {false, false}, {}, h};
    resolve_together(srif, h);
    return srif;
  };
  CHECK(in_plane(0, 5.9).membrane->resolved == std::array{true, true});  // N h / 6 beside K1 = 1: a tenth at 6
  CHECK(in_plane(0, 6.1).membrane->resolved == std::array{false, false});
  CHECK(in_plane(120, 11.9).membrane->resolved == std::array{true, true});  // beside N1 itself
  auto bending = in_plane(600, 1);                                          // N1 h / 6 = 10
  bending.errors = {0.9, 1.1, 9}, bending.resolved = {false, false, false}, bending.membrane->resolved = {true, true};
  resolve_together(bending, h);
  CHECK(bending.resolved == std::array{true, false, true});
  CHECK(largest_with_plane(bending, h) == Approx(10));
  bending.G = -1, bending.resolved = {false, false, false};  // an energy that is not positive leaves nothing
  resolve_together(bending, h);
  CHECK(bending.resolved == std::array{false, false, false});
}

TEST_CASE("N2 of a crack that is closed at both faces is zero where it is rounding beside the forces") {
  const double h = unit_section.thickness, scale = 5;
  const auto closed = [&](double N2, double error) {
    Srif srif;
    srif.K1 = 1e-13, srif.K2 = 1e-13, srif.errors = {1e-12, 1e-12, 1e-12}, srif.G = 1e-25;
    srif.membrane = MembraneFactors{{-2, N2}, {0.01, error}, {true, false}, 1e-3, h};
    std::vector<Srif> all{srif};
    close(all, {{.top = true, .bottom = true, .scale = scale}}, unit_section);
    return all[0];
  };
  const auto rounded = closed(-2e-13, 2e-12);
  CHECK(rounded.membrane->N == std::array{0.0, 0.0});
  CHECK(rounded.membrane->G == 0);
  CHECK(rounded.membrane->errors[1] == 2e-12);
  CHECK(warnings_about_factors({rounded}, {}, h, "").empty());
  CHECK(closed(1e-3, 1e-12).membrane->N[1] == 1e-3);  // it slides
  const auto doubtful = closed(1e-9, 0.04);
  CHECK(doubtful.membrane->N[1] == 1e-9);
  const auto said = warnings_about_factors({doubtful}, {}, h, "refine");
  REQUIRE(said.size() == 1);
  CHECK(said[0] == "tip 0 (0, 0): N2 uncertain (> 100 %); refine");
}

TEST_CASE("a tip has one warning, with all factors that are in doubt and the largest of their errors") {
  const double h = unit_section.thickness;
  Srif srif;
  srif.tip = 2, srif.K1 = 1, srif.errors = {0.01, 0.05, 3}, srif.resolved = {true, true, false};
  srif.membrane = MembraneFactors{{60, 0}, {2.4, 0.1}, {true, true}, {}, h};
  const auto said = warnings_about_factors({srif}, {}, h, "set spacing = 0.1");
  REQUIRE(said.size() == 1);
  CHECK(said[0] == "tip 2 (0, 0): K3 unresolved (30 %), K2, N1 uncertain (5 %); set spacing = 0.1");
  srif.errors = {0.01, 0.01, 0.01}, srif.resolved = {true, true, true}, srif.membrane.reset();
  CHECK(warnings_about_factors({srif}, {}, h, "").empty());
}
