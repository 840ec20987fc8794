// Bonds that are severed while a plate moves, against plates that are made with the crack.
#include "fracture/breakage/damaged_plate.hpp"

#include "plate/bonds/rows/lattice_operator.hpp"
#include "tests/catch.hpp"
#include "tests/verification/verified_plate.hpp"

using namespace fracture;
namespace vp = verified_plate;

namespace {

/// A plate held at two edges with a crack from an edge, whose second piece may be missing.
std::unique_ptr<plate::Formulation> cracked(const geometry::Polyline& crack) {
  auto c = vp::square(0.1);
  c.supports = {vp::held(plate::SupportKind::clamped, {"left"}),
                vp::held(plate::SupportKind::simply_supported, {"top"})};
  c.cracks = {crack};
  return vp::assembled(c);
}

const plate::FamilyRule rule(vp::section, vp::square(0.1).discretization);

std::optional<std::size_t> broken(DamagedPlate& plate, const geometry::CrackPath& path, double piece) {
  return plate.break_bonds({{path, true, piece}}).at(0);
}

double largest(const plate::Forces& forces) {
  return forces.cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("own families: energies and forces of all families are those of the operator") {
  const auto a = cracked({{-0.4, -0.3}, {0.2, 0.1}});
  const auto& op = *a->breaking();
  const auto u = vp::random_state(*a, 1), v = vp::random_state(*a, 2);
  const auto energies = op.energies(u);
  plate::Forces expected, found = plate::Forces::Zero(3, u.cols());
  op.internal_force(u, expected);
  double mixed = 0, sum = 0;
  for (std::uint32_t k = 0; k < op.points(); ++k) {
    plate::OwnFamily family{k, a->cloud().areas[k], op.weights().a[op.weights().kind[k]], {}};
    for (std::size_t i = 0; i < op.families()[k].size(); ++i) {
      const auto [j, id] = op.families()[k][i];
      const auto& shape = op.shapes()[id];
      family.bonds.push_back({j, shape.mx, shape.my, shape.length, op.weights().of(k, i)});
    }
    CHECK(energy(family, u, u) == Approx(energies[k]).margin(1e-12 * energies.maxCoeff()));
    mixed += energy(family, u, v), sum += energy(family, v, u);
    add_force(family, u, 1, found);
  }
  CHECK(largest(found - expected) < 1e-12 * largest(expected));
  CHECK(mixed == Approx(sum));
  CHECK(mixed == Approx(-expected.cwiseProduct(v).sum() / 2));
}

TEST_CASE(
    "severed plate: all severed, it is the plate with the longer crack, on the way, its energy has fallen by what was "
    "taken") {
  const geometry::Polyline first{{-1, -0.25}, {-0.35, -0.25}}, second{{-1, -0.25}, {-0.35, -0.25}, {0.15, 0.1}};
  for (const auto& [from, to, piece] :
       {std::tuple{first, second, 0.61},
        {second, geometry::Polyline{{-1, -0.25}, {-0.35, -0.25}, {0.45, 0.31}}, 0.37}}) {
    const auto before = cracked(from), after = cracked(to);
    DamagedPlate damaged(*before->breaking(), before->boundary(), rule);
    const auto u = vp::random_state(*before, 3);
    plate::Forces old, whole, half, wanted;
    before->internal_force(u, old);
    after->internal_force(u, wanted);
    REQUIRE(largest(wanted - old) > 1e-3 * largest(old));

    damaged.internal_force(u, whole);
    CHECK((whole.array() == old.array()).all());  // nothing has happened
    const auto number = broken(damaged, after->paths()[0], piece);
    REQUIRE(number);
    CHECK(broken(damaged, after->paths()[0], piece) ==
          std::optional<std::size_t>(*number + 1));  // nothing is left to cut
    const plate::State rest = plate::State::Zero(3, u.cols());
    const double drop = (before->strain_energy(u) - after->strain_energy(u));
    const double half_drop = damaged.carry_on(*number, 0.5, {u, rest, 0.1});
    damaged.internal_force(u, half);
    CHECK(-half.cwiseProduct(u).sum() / 2 == Approx(before->strain_energy(u) - half_drop));
    CHECK(largest(half - old) > 1e-4 * largest(old));
    CHECK(half_drop + damaged.carry_on(*number, 1, {u, rest, 0.1}) == Approx(drop));
    damaged.internal_force(u, whole);
    CHECK(largest(whole - wanted) < 1e-12 * largest(old));
    CHECK(damaged.families().bonds() == after->families().bonds());
  }
}

TEST_CASE("severed plate: a piece through points of a severing that goes on has to wait") {
  const auto a = cracked({{-1, -0.25}, {-0.35, -0.25}});
  DamagedPlate damaged(*a->breaking(), a->boundary(), rule);
  auto path = a->paths()[0];
  path.vertices.back() = {-0.15, -0.25};
  const auto number = broken(damaged, path, 0.2);
  REQUIRE(number);
  path.vertices.back() = {0.05, -0.25};
  CHECK_FALSE(broken(damaged, path, 0.2));
  const auto u = vp::random_state(*a, 4);
  damaged.carry_on(*number, 1, {u, u, 0});
  CHECK(broken(damaged, path, 0.2));
}

TEST_CASE("severed plate: pieces that share points are one breakage, whichever comes first, and others are not") {
  const auto a = cracked({{-1, -0.25}, {-0.35, -0.25}});
  const auto piece = [](double x, double y) {
    return CrackPiece{{{{x, y}, {x + 0.2, y}}, geometry::End::tip, geometry::End::tip}, true, 0.2};
  };
  const std::vector<CrackPiece> pieces{piece(-0.35, -0.25), piece(0.45, 0.65), piece(-0.05, -0.15)};
  DamagedPlate damaged(*a->breaking(), a->boundary(), rule), turned(*a->breaking(), a->boundary(), rule);
  const auto numbers = damaged.break_bonds(pieces);
  REQUIRE((numbers[0] && numbers[1]));
  CHECK(numbers[0] == numbers[2]);
  CHECK(numbers[0] != numbers[1]);
  CHECK(turned.break_bonds({pieces.rbegin(), pieces.rend()})[0] == std::optional<std::size_t>(0));
  const auto u = vp::random_state(*a, 5);
  plate::Forces found, other;
  for (auto* one : {&damaged, &turned})
    for (const std::size_t number : {0, 1}) one->carry_on(number, 1, {u, u, 0});
  damaged.internal_force(u, found), turned.internal_force(u, other);
  CHECK(largest(found - other) < 1e-12 * largest(found));
}

TEST_CASE("severed plate: with every surface correction it becomes the plate with the longer crack") {
  using plate::SurfaceCorrection;
  for (const auto correction :
       {SurfaceCorrection::none, SurfaceCorrection::volume, SurfaceCorrection::arbitrary_horizon}) {
    const auto with = [&](const geometry::Polyline& crack) {
      auto c = vp::square(0.1);
      c.discretization.surface_correction = correction;
      c.supports = {vp::held(plate::SupportKind::clamped, {"left"})};
      c.cracks = {crack};
      return c;
    };
    const auto first = with({{-1, -0.25}, {-0.35, -0.25}});
    const auto before = vp::assembled(first), after = vp::assembled(with({{-1, -0.25}, {0.25, -0.25}}));
    DamagedPlate damaged(*before->breaking(), before->boundary(), {first.section, first.discretization});
    const auto u = vp::random_state(*before, 6);
    const auto number = broken(damaged, after->paths()[0], 0.6);
    REQUIRE(number);
    damaged.carry_on(*number, 1, {u, u, 0});
    plate::Forces found, wanted;
    damaged.internal_force(u, found);
    after->internal_force(u, wanted);
    CHECK(largest(found - wanted) < 1e-12 * largest(wanted));
  }
}
