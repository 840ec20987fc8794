#include "plate/formulation/constraints.hpp"

#include "plate/model/halo_exchange.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/small_plate.hpp"

using plate::Constraints;
using plate::Dof;
using plate::dof_by_points;
using plate::Forces;
using plate::State;

namespace {

constexpr Eigen::Index constrained_points = 4;  // 12 degrees of freedom

/// P column by column: the action on unit vectors.
Eigen::MatrixXd action(const Constraints& constraints) {
  Eigen::MatrixXd P(3 * constrained_points, 3 * constrained_points);
  for (Eigen::Index n = 0; n < P.cols(); ++n) {
    State unit = State::Zero(3, constrained_points);
    plate::at_dof(unit, dof_by_points(n)) = 1;
    constraints.impose(unit);
    P.col(n) = unit.reshaped();
  }
  return P;
}

/// Degree of freedom by its number where the values of a point stand together.
Dof d(int number) {
  return dof_by_points(number);
}

Constraints several() {
  Constraints c;
  c.fix(d(0));
  c.tie(d(1), {{d(2), 0.5}});  // chain 1 -> 2 -> 3
  c.tie(d(2), {{d(3), -3}});
  c.tie(d(4), {{d(0), 7}});  // follows a fixed one
  c.tie(d(5), {{d(3), 2}});  // two followers of one leader
  c.tie(d(5), {{d(8), 9}});  // held twice: the first counts
  c.tie(d(6), {{d(7), 1}});  // ring
  c.tie(d(7), {{d(6), 1}});
  c.tie(d(9), {{d(6), 1}});  // leads into the ring
  c.resolve();
  return c;
}

}  // namespace

TEST_CASE("chains end at a free leader, fixed leaders and rings hold at zero") {
  const Constraints c = several();
  CHECK(c.fixed() == std::vector<Dof>{d(0), d(4), d(6), d(7), d(9)});
  REQUIRE(c.ties().size() == 3);
  const auto is = [&](std::size_t i, int follower, int leader, double factor) {
    CHECK(c.ties()[i].follower == d(follower));
    CHECK(c.ties()[i].leader == d(leader));
    CHECK(c.ties()[i].factor == factor);
  };
  is(0, 1, 3, -1.5);
  is(1, 2, 3, -3);
  is(2, 5, 3, 2);
  for (int dof = 0; dof < 12; ++dof)
    CHECK(c.held(d(dof)) ==
          (dof == 0 || dof == 1 || dof == 2 || dof == 4 || dof == 5 || dof == 6 || dof == 7 || dof == 9));
}

TEST_CASE("a fixed degree of freedom that is also tied stays fixed") {
  Constraints c;
  c.tie(d(3), {{d(5), 1}});
  c.fix(d(3));
  c.resolve();
  CHECK(c.ties().empty());
  CHECK(c.fixed() == std::vector<Dof>{d(3)});
}

TEST_CASE("impose is a projection, a free state stays as it is") {
  const Constraints c = several();
  State u = small_plate::random_state(constrained_points, 3);
  const State before = u;
  c.impose(u);
  CHECK(plate::at_dof(u, dof_by_points(0)) == 0);
  CHECK(plate::at_dof(u, dof_by_points(1)) == -1.5 * plate::at_dof(before, dof_by_points(3)));
  CHECK(plate::at_dof(u, dof_by_points(8)) == plate::at_dof(before, dof_by_points(8)));
  State again = u;
  c.impose(again);
  CHECK(again == u);
}

TEST_CASE("folds are the transposes that they say") {
  const Constraints c = several();
  // P takes its values from the free degrees of freedom alone
  Eigen::MatrixXd P = action(c);
  for (int dof = 0; dof < 12; ++dof)
    if (c.held(d(dof))) P.col(dof).setZero();
  const Forces f = small_plate::random_state(constrained_points, 4);

  Forces folded = f, absolute = f, diagonal = f;
  c.fold(folded);
  c.fold_absolute(absolute);
  c.fold_diagonal(diagonal);
  const Eigen::VectorXd flat = f.reshaped();
  const Eigen::MatrixXd square = P.transpose() * flat.asDiagonal() * P;
  CHECK((folded.reshaped() - P.transpose() * flat).norm() < 1e-14);               // measured: 4e-16
  CHECK((absolute.reshaped() - P.cwiseAbs().transpose() * flat).norm() < 1e-14);  // measured: 2e-16
  CHECK((diagonal.reshaped() - square.diagonal()).norm() < 1e-14);                // measured: 1e-15
}

TEST_CASE("a symmetric stiffness stays symmetric") {
  const Constraints c = several();
  const Eigen::MatrixXd half = Eigen::MatrixXd::NullaryExpr(
      12, 12, [](Eigen::Index i, Eigen::Index j) { return std::sin(double(3 * i + 5 * j)); });
  const Eigen::MatrixXd K = half + half.transpose();
  Eigen::MatrixXd reduced(12, 12);
  for (Eigen::Index n = 0; n < 12; ++n) {
    State unit = State::Zero(3, constrained_points);
    if (!c.held(dof_by_points(n))) plate::at_dof(unit, dof_by_points(n)) = 1;
    c.impose(unit);
    Forces f(3, constrained_points);
    f.reshaped() = K * unit.reshaped();
    c.fold(f);
    reduced.col(n) = f.reshaped();
  }
  CHECK(reduced.norm() > 1);
  CHECK((reduced - reduced.transpose()).norm() < 1e-14);  // measured: 1e-15
}

namespace {

/// Of four points the last two are others'. They come at the end, when own values may long have changed.
class FromOthers : public plate::HaloExchange {
public:
  explicit FromOthers(State theirs) : theirs_(std::move(theirs)) {}
  void start(std::span<double> values) const override {
    ++begun, values_ = values;
    for (const std::size_t at : {2, 3, 6, 7, 10, 11}) values[at] = NAN;
  }
  void start(std::span<float>) const override { FAIL("nobody asked for these"); }
  void finish() const override {
    for (const std::size_t at : {2, 3, 6, 7, 10, 11}) values_[at] = theirs_.data()[at];
  }
  void progress() const override { ++helped; }

  mutable int begun = 0, helped = 0;

private:
  State theirs_;
  mutable std::span<double> values_;
};

}  // namespace

TEST_CASE("what follows own points is there at once, what is of others or follows them once that has come") {
  const State given = small_plate::random_state(constrained_points, 8),
              theirs = small_plate::random_state(constrained_points, 9);
  const auto others = std::make_shared<FromOthers>(theirs);
  Constraints c;
  c.fix(d(1)), c.fix(d(7));               // own, and a copy: zero whatever comes
  c.tie(d(2), {{d(3), 2}});               // own follows own
  c.tie(d(4), {{d(9), 0.5}, {d(0), 1}});  // own follows a copy too
  c.tie(d(10), {{d(0), 3}});              // a copy follows own
  c.resolve();
  c.share(plate::single_process(), {2, 3}, others);
  CHECK(c.pending(constrained_points) == std::vector<char>{0, 1, 1, 1});

  State whole = given, halves = given;
  c.impose(whole);
  CHECK(whole(0, 0) == given(0, 0));
  CHECK(whole(1, 0) == 0);
  CHECK(whole(2, 0) == 2 * given(0, 1));
  CHECK(whole(1, 1) == 0.5 * theirs(0, 3) + given(0, 0));
  CHECK(whole(0, 2) == theirs(0, 2));
  CHECK(whole(1, 2) == 0);
  CHECK(whole(1, 3) == 3 * given(0, 0));
  {
    plate::PendingExchange rest(c, halves);
    CHECK(halves.col(0) == whole.col(0));
    CHECK(halves(1, 1) == given(1, 1));
    CHECK(std::isnan(halves(0, 2)));
    rest.progress();
    CHECK(others->helped == 1);
    rest.complete();
    CHECK(halves == whole);
    halves(0, 2) = 7;
    rest.complete(), rest.progress();  // nothing is left to be done
    CHECK(halves(0, 2) == 7);
    CHECK(others->helped == 1);
  }
  CHECK(halves(0, 2) == 7);
  halves = given;
  { const plate::PendingExchange rest(c, halves); }  // whoever forgets it has it completed
  CHECK(halves == whole);
  CHECK(others->begun == 3);

  Forces f = Forces::Ones(3, constrained_points);
  c.fold(f);
  CHECK(f(0, 0) == 1 + 1 + 3);  // of what follows it, whoever's that is
  CHECK(f.rightCols(2).isZero());
  CHECK(f(1, 1) == 0);
}

TEST_CASE("one process waits for nothing") {
  const Constraints c = several();
  CHECK(c.pending(constrained_points).empty());
  State u = small_plate::random_state(constrained_points, 3), imposed = u;
  c.impose(imposed);
  plate::PendingExchange rest(c, u);
  CHECK(u == imposed);
  rest.progress(), rest.complete();
  CHECK(u == imposed);
}
