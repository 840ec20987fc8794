#include <numbers>

#include "geometry/lattice/cloud.hpp"
#include "plate/bonds/results.hpp"
#include "post/factors/series_fit.hpp"
#include "post/factors/tip_integrals.hpp"
#include "post/factors/tip_section.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/small_plate.hpp"

using namespace post;
using geometry::Point;

namespace {

const plate::Section section{1000, 0.3, 200, 5.0 / 6, 1};  // 200 spacings thick

/// G of a state without forces.
double release_rate(const TipView& plate, const geometry::Tip& tip, const Ring& ring, bool by_extension,
                    const plate::State& state) {
  const TipFrame frame(tip);
  const TipSurroundings surroundings(plate, tip, ring.outer);
  const TipIntegral integral(surroundings, ring,
                             by_extension ? plate.virtual_extension(frame, ring) : domain_integral(plate, frame, ring));
  const plate::Forces none = plate::Forces::Zero(3, state.cols());
  return integral(NearField(state, plate.positions, surroundings.centre()),
                  surroundings.forward_work(state, none, ring.outer));
}

/// A plate of 60 x 60 spacings with a crack from its left edge to the middle.
struct Scene {
  geometry::Cloud cloud = geometry::lattice(geometry::rectangle(0, 0, 60, 60), 1);
  std::vector<geometry::CrackPath> paths =
      geometry::crack_paths(geometry::rectangle(0, 0, 60, 60), {{{0, 30}, {30, 30}}}, 1e-9);
  geometry::Tip tip = geometry::tips(paths).at(0);
  geometry::Families families = geometry::without(
      geometry::families(cloud, 3.015, [](auto, auto) { return true; }), [this](std::uint32_t k, std::uint32_t j) {
        return geometry::separates(paths[0], cloud.positions[k], cloud.positions[j]);
      });
  std::vector<plate::BondShape> shapes = plate::bond_shapes(families.vectors(), section, small_plate::spaced(1));
  plate::BondView plate{cloud, families, shapes, section, small_plate::spaced(1)};

  plate::State field(int mode) const {
    const TipSeries series(section, section.thickness, 3);
    Eigen::Index own = 0;  // the field that has this factor alone
    series.factors().row(mode).cwiseAbs().maxCoeff(&own);
    plate::State state(3, Eigen::Index(cloud.size()));
    for (std::size_t k = 0; k < cloud.size(); ++k) {
      const Eigen::Vector3d u =
          series({polar(TipFrame(tip), cloud.positions[k], 1)}).col(own) / series.factors()(mode, own);
      state.col(Eigen::Index(k)) << u[0], u[2], -u[1];
    }
    return state;
  }
};

}  // namespace

TEST_CASE("a unit field sampled on the lattice has its own energy release rate and factors") {
  const Scene s;
  const Ring ring{4, 8};
  const SeriesFit fit = series_fits(s.plate, s.tip, {3, 9, 6}, {1}).at(0);
  for (int mode = 0; mode < 3; ++mode) {
    const auto state = s.field(mode);
    const double unit = TipSection(section).unit_release()[mode];
    const Eigen::Vector3d K = fit(NearField(state, s.cloud.positions, {}));
    const double moved = release_rate(s.plate, s.tip, ring, true, state),
                 domain = release_rate(s.plate, s.tip, ring, false, state);
    CAPTURE(mode, moved / unit, domain / unit, K.transpose());
    CHECK(domain == Approx(unit).epsilon(0.02));
    CHECK((K - Eigen::Vector3d::Unit(mode)).cwiseProduct(Eigen::Vector3d(1, 1, section.thickness)).norm() < 1e-6);
    if (mode == 0) CHECK(moved == Approx(unit).epsilon(0.02));
  }
}

TEST_CASE("rigid motions and constant curvature release no energy") {
  const Scene s;
  const Ring ring{4, 8};
  plate::State state(3, Eigen::Index(s.cloud.size()));
  for (Eigen::Index k = 0; k < state.cols(); ++k) {
    const Point& x = s.cloud.positions[std::size_t(k)];
    // bending along the crack, kappa_xx = 1 and kappa_yy = -nu: no moment on the faces; and a rigid motion
    state.col(k) << x.x() * x.x() / 2 - 0.3 * x.y() * x.y() / 2 + 3 + 40 * x.x(), -0.3 * x.y(), -x.x() - 40;
  }
  for (const bool by_extension : {true, false}) {
    const double G = release_rate(s.plate, s.tip, ring, by_extension, state);
    const double scale = section.bending_stiffness() * ring.outer;  // energy per length of the ring
    CHECK(std::abs(G) < 1e-3 * scale);  // measured: 1e-4, the quadrature of div q over the lattice
  }
}
