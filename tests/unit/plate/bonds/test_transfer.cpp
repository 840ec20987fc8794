#include "plate/bonds/preconditioners.hpp"

#include "tests/catch.hpp"
#include "tests/unit/plate/small_plate.hpp"

using namespace plate;
using geometry::Point;

namespace {

/// Values of a field at all points, or at the coarse ones: cells with two even numbers.
template <typename Field>
State values(const small_plate::Model& m, bool coarse, const Field& field) {
  std::vector<Eigen::Vector3d> columns;
  for (std::size_t k = 0; k < m.boundary.lattice.size(); ++k) {
    const Point cell = m.boundary.lattice[k].array().floor();
    if (!coarse || (int(cell.x()) % 2 == 0 && int(cell.y()) % 2 == 0))
      columns.push_back(field(m.boundary.cloud.positions[k]));
  }
  State result(3, Eigen::Index(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i) result.col(Eigen::Index(i)) = columns[i];
  return result;
}

small_plate::Model cracked() {
  const auto outline = geometry::rectangle(0, 0, 2, 1.5);
  auto cracks = geometry::crack_paths(outline, {{{0.5, 0.43}, {1.4, 0.91}}}, 1e-9);
  for (auto& vertex : cracks[0].vertices) vertex /= 0.1;
  return small_plate::model(outline, {}, small_plate::spaced(0.1), cracks);
}

}  // namespace

TEST_CASE("transfer: rigid motions exactly, at cracks and edges too, bending without shear where points lie about") {
  const auto m = cracked();
  const Transfer transfer(m.plate.families(), m.boundary);
  const auto error = [&](const auto& field) {
    State fine = State::Zero(3, m.points());
    transfer.prolong(values(m, true, field), fine);
    return State((fine - values(m, false, field)).cwiseAbs());
  };
  // w,x = -theta_y, w,y = theta_x
  const State rigid = error([](const Point& x) { return Eigen::Vector3d(1 + 2 * x.x() - 3 * x.y(), -3, -2); });
  CHECK(rigid.maxCoeff() < 1e-6);  // measured: 1e-7, levers in single precision
  const State bent =
      error([](const Point& x) { return Eigen::Vector3d(x.x() * x.x() / 2 + x.x() * x.y(), x.x(), -x.x() - x.y()); });
  std::size_t exact = 0;
  for (Eigen::Index k = 0; k < bent.cols(); ++k) exact += bent.col(k).maxCoeff() < 1e-6;
  CHECK(exact > 0.75 * double(m.points()));  // all but those beside edges and the crack
}

TEST_CASE("transfer: restriction is the transpose") {
  const auto m = cracked();
  const Transfer transfer(m.plate.families(), m.boundary);
  const State coarse = small_plate::random_state(Eigen::Index(transfer.coarse_points()), 31),
              force = small_plate::random_state(m.points(), 32);
  State fine = State::Zero(3, m.points()), restricted;
  transfer.prolong(coarse, fine);
  transfer.restrict_to(restricted, force);
  const double one = fine.cwiseProduct(force).sum(), other = coarse.cwiseProduct(restricted).sum();
  CHECK(std::abs(one - other) < 1e-12 * fine.norm() * force.norm());  // measured: 1e-17
}

TEST_CASE("transfer: nothing goes across a crack") {
  const auto m = cracked();
  const Transfer transfer(m.plate.families(), m.boundary);
  const Point a(0.5, 0.43), b(1.4, 0.91);
  const auto above = [&](const Point& x) { return (b - a).x() * (x - a).y() - (b - a).y() * (x - a).x() > 0; };
  const auto between = [&](const Point& x) { return (x - a).dot(b - a) > 0.1 && (x - b).dot(a - b) > 0.1; };
  const State upper = values(m, true, [&](const Point& x) { return Eigen::Vector3d(above(x), 0, 0); });
  State fine = State::Zero(3, m.points());
  transfer.prolong(upper, fine);
  std::size_t seen = 0;
  for (Eigen::Index k = 0; k < fine.cols(); ++k) {
    const Point& x = m.boundary.cloud.positions[std::size_t(k)];
    if (!between(x) || std::abs((b - a).x() * (x - a).y() - (b - a).y() * (x - a).x()) > 0.1) continue;
    ++seen;
    CHECK((std::abs(fine(0, k) - above(x)) < 1e-6 || fine.col(k).norm() == 0));  // zero: bonded to no coarse point
  }
  CHECK(seen > 10);
}
