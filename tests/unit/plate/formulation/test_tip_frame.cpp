#include "plate/formulation/tip_view.hpp"

#include <numbers>

#include "tests/catch.hpp"

using namespace plate;
using geometry::Point;

TEST_CASE("tip frame: a point on the line of a crack is on the face where severed bonds have it") {
  for (const Point& ahead : {Point(1, 0), Point(-1, 0), Point(0, 1), Point(0, -1), Point(0.6, 0.8), Point(-0.6, 0.8),
                             Point(-0.8, -0.6), Point(0.8, -0.6)}) {
    const geometry::CrackPath path{{-4 * ahead, {0, 0}}, geometry::End::mouth, geometry::End::tip};
    const TipFrame frame(geometry::tips({path}).at(0));
    const Point on = -2 * ahead;  // exact
    CAPTURE(ahead.transpose());
    CHECK(geometry::separates(path, on, on + frame.left()) == (face_of(0, frame.left(), 1) < 0));
    CHECK(geometry::separates(path, on, on - frame.left()) == (face_of(0, frame.left(), 1) > 0));
    CHECK(polar(frame, on, 1).angle == face_of(0, frame.left(), 1) * std::numbers::pi);
  }
}

TEST_CASE("tip frame: rounding does not change the face, what is beside the line does") {
  const TipFrame frame({{1, 2}, {0, 1}, 0, true});
  CHECK(face_of(1e-9, frame.left(), 1) == face_of(-1e-9, frame.left(), 1));
  CHECK(face_of(1e-3, frame.left(), 1) == 1);
  CHECK(face_of(-1e-3, frame.left(), 1) == -1);
  CHECK(face_of(-1e-9, frame.left(), 1e-6) == -1);  // beside the line where spacings are small
}

TEST_CASE("tip frame: polar coordinates are those of the turned axes, zero ahead, positive to the left") {
  const double turn = 0.7;
  const TipFrame frame({{3, -1}, {std::cos(turn), std::sin(turn)}, 0, true});
  for (int i = -9; i <= 9; ++i) {
    const double angle = 0.33 * i, r = 0.5 + 0.1 * i * i;
    const Point x = frame.origin + r * Point(std::cos(turn + angle), std::sin(turn + angle));
    const auto found = polar(frame, x, 1);
    CHECK(found.r == Approx(r));
    CHECK(found.angle == Approx(angle).margin(1e-14));
  }
  CHECK(polar(frame, frame.origin, 1).r == 0);
}
