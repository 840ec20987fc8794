#include <numbers>

#include "post/factors/series_fit.hpp"
#include "tests/catch.hpp"

using namespace post;

namespace {

/// w, psi_x, psi_y of all fields and their derivatives at a place, by central differences of the fourth order.
struct Derivatives {
  Eigen::Matrix3Xd value, x, y, xx, yy, xy;
};

Derivatives derivatives(const TipSeries& series, double r, double angle, double step) {
  const auto at = [&](int i, int j) {
    const double x = r * std::cos(angle) + i * step, y = r * std::sin(angle) + j * step;
    return series({{std::hypot(x, y), std::atan2(y, x)}});
  };
  const auto first = [&](auto&& f) -> Eigen::Matrix3Xd { return (8 * (f(1) - f(-1)) - (f(2) - f(-2))) / (12 * step); };
  const auto second = [&](auto&& f) -> Eigen::Matrix3Xd {
    return (16 * (f(1) + f(-1)) - (f(2) + f(-2)) - 30 * f(0)) / (12 * step * step);
  };
  Derivatives d{at(0, 0),
                first([&](int i) { return at(i, 0); }),
                first([&](int j) { return at(0, j); }),
                second([&](int i) { return at(i, 0); }),
                second([&](int j) { return at(0, j); }),
                {}};
  d.xy = first([&](int i) -> Eigen::Matrix3Xd { return first([&](int j) { return at(i, j); }); });
  return d;
}

}  // namespace

TEST_CASE("fields about a tip: equilibrium inside") {
  for (const double nu : {-0.3, 0.0, 0.3, 0.49})
    for (const double thickness : {0.4, 1.0, 5.0}) {
      const plate::Section section{1000, nu, thickness, 5.0 / 6, 1};
      const double s = section.shear_stiffness() / section.bending_stiffness();
      const TipSeries series(section, 1, 8);
      for (const double angle : {-2.5, -0.4, 0.9, 2.0}) {
        const auto d = derivatives(series, 0.6, angle, 2e-3);
        CAPTURE(nu, thickness, angle);
        for (Eigen::Index n = 0; n < series.size(); ++n) {
          const double size =
              std::abs(s) * d.value.col(n).cwiseAbs().maxCoeff() + d.xx.col(n).norm() + d.yy.col(n).norm();
          const double mx =
              d.xx(1, n) + (1 - nu) / 2 * d.yy(1, n) + (1 + nu) / 2 * d.xy(2, n) + s * (d.x(0, n) - d.value(1, n));
          const double my =
              d.yy(2, n) + (1 - nu) / 2 * d.xx(2, n) + (1 + nu) / 2 * d.xy(1, n) + s * (d.y(0, n) - d.value(2, n));
          const double q = d.xx(0, n) + d.yy(0, n) - d.x(1, n) - d.y(2, n);
          CAPTURE(n);
          CHECK(std::abs(mx) < 1e-6 * size);
          CHECK(std::abs(my) < 1e-6 * size);
          CHECK((std::abs(q) < 1e-6 * size || std::abs(q - 1) < 1e-6 * size));  // 1: of the even load
        }
      }
    }
}

TEST_CASE("fields about a tip: free curvatures that grow ahead and to the left, with free faces") {
  const plate::Section section{1000, 0.3, 0.8, 5.0 / 6, 1};
  const double nu = section.poisson, s = section.shear_stiffness() / section.bending_stiffness();
  const TipSeries series(section, 1, 8, true), cold(section, 1, 8);
  REQUIRE(series.size() == cold.size() + 2);
  // the last field of either symmetry: kappa_0 = x, and kappa_0 = -y
  const Eigen::Index even = cold.size() / 2;
  int found = 0;
  for (Eigen::Index n = 0; n < series.size(); ++n) {
    // mx, my of equilibrium are (1 + nu) grad kappa_0
    const auto residual = [&](double angle) -> Eigen::Vector2d {
      const auto d = derivatives(series, 0.6, angle, 2e-3);
      return {d.xx(1, n) + (1 - nu) / 2 * d.yy(1, n) + (1 + nu) / 2 * d.xy(2, n) + s * (d.x(0, n) - d.value(1, n)),
              d.yy(2, n) + (1 - nu) / 2 * d.xx(2, n) + (1 + nu) / 2 * d.xy(1, n) + s * (d.y(0, n) - d.value(2, n))};
    };
    if (residual(0.9).norm() < 1e-4) continue;
    const Eigen::Vector2d gradient = n <= even + 2 ? Eigen::Vector2d(1, 0) : Eigen::Vector2d(0, -1);
    for (const double angle : {-2.5, -0.4, 0.9, 2.0})
      CHECK((residual(angle) - (1 + nu) * gradient).norm() < 1e-4);  // measured: 2e-6
    CHECK(series.factors().col(n).isZero(0));
    ++found;
  }
  CHECK(found == 2);
}

TEST_CASE("fields about a tip: free faces, and the factors of what is ahead") {
  const plate::Section section{1000, 0.3, 0.8, 5.0 / 6, 1};
  const double nu = section.poisson, D = section.bending_stiffness(), S = section.shear_stiffness();
  const TipSeries series(section, 1, 10);
  for (const double r : {0.1, 0.4, 0.7, 1.0})
    for (const double face : {1.0, -1.0}) {
      // one-sided differences across the face, from within the plate
      const double step = 1e-5;
      const auto at = [&](double along, int n) {
        const double y = n * step;
        return series({{std::hypot(along, y), face * (std::numbers::pi - std::atan2(y, along))}});
      };
      const Eigen::Matrix3Xd across = face * (4 * at(r, 1) - 3 * at(r, 0) - at(r, 2)) / (2 * step);
      const Eigen::Matrix3Xd along = -(at(r + step, 0) - at(r - step, 0)) / (2 * step);
      const Eigen::Matrix3Xd here = at(r, 0);
      for (Eigen::Index n = 0; n < series.size(); ++n) {
        const double size = across.col(n).norm() + along.col(n).norm() + here.col(n).norm();
        CAPTURE(r, face, n);
        CHECK(std::abs(across(2, n) + nu * along(1, n)) < 1e-6 * size);
        CHECK(std::abs(across(1, n) + along(2, n)) < 1e-6 * size);
        CHECK(std::abs(across(0, n) - here(2, n)) < 1e-6 * size);
      }
    }
  const double r = 1e-8, step = 1e-3 * r, root = std::sqrt(2 * r);
  const auto at = [&](double x, double y) { return series({{std::hypot(x, y), std::atan2(y, x)}}); };
  const Eigen::Matrix3Xd x = (at(r + step, 0) - at(r - step, 0)) / (2 * step),
                         y = (at(r, step) - at(r, -step)) / (2 * step);
  for (Eigen::Index n = 0; n < series.size(); ++n) {
    const double M1 = -D * (y(2, n) + nu * x(1, n)), M2 = -D * (1 - nu) / 2 * (y(1, n) + x(2, n)),
                 Q = S * (y(0, n) - at(r, 0)(2, n));
    const double size = series.factors().cwiseAbs().maxCoeff();
    CAPTURE(n);
    CHECK(std::abs(root * M1 - series.factors()(0, n)) < 1e-3 * size);  // what is regular there is r^(1/2) = 1e-4 of it
    CHECK(std::abs(root * M2 - series.factors()(1, n)) < 1e-3 * size);
    CHECK(std::abs(root * Q - series.factors()(2, n)) < 1e-3 * size);
  }
}

TEST_CASE("fields about a tip: faces of a curve are free to the first order of its curvature") {
  const auto left = [](const plate::Section& section, double curvature) {
    const double nu = section.poisson;
    const TipSeries series(section, 1, 6, false, curvature);
    Eigen::ArrayXd worst = Eigen::ArrayXd::Zero(series.size());
    for (const double r : {0.5, 0.9})
      for (const int side : {1, -1}) {
        const double step = 1e-3;
        const auto at = [&](int i, int j) {
          const double x = -r + i * step, y = curvature * r * r / 2 + j * step, angle = std::atan2(y, x);
          const double on = side * angle > 0 ? angle : angle + side * 2 * std::numbers::pi;
          return series({{std::hypot(x, y), on}});
        };
        const auto slope = [&](auto&& f) -> Eigen::Matrix3Xd {
          return (8 * (f(1) - f(-1)) - (f(2) - f(-2))) / (12 * step);
        };
        const Eigen::Matrix3Xd value = at(0, 0), x = slope([&](int i) { return at(i, 0); }),
                               y = slope([&](int j) { return at(0, j); });
        const Eigen::Vector2d normal = Eigen::Vector2d(curvature * r, 1).normalized();
        for (Eigen::Index n = 0; n < series.size(); ++n) {
          Eigen::Matrix2d moments;
          const double twist = (1 - nu) / 2 * (y(1, n) + x(2, n));
          moments << x(1, n) + nu * y(2, n), twist, twist, y(2, n) + nu * x(1, n);
          const Eigen::Vector2d shear(x(0, n) - value(1, n), y(0, n) - value(2, n));
          worst[n] = std::max(worst[n], (moments * normal).norm() + std::abs(shear.dot(normal)));
        }
      }
    return worst;
  };
  for (const double thickness : {2.0, 50.0}) {
    const plate::Section section{1000, 0.3, thickness, 5.0 / 6, 1};
    const auto coarse = left(section, 0.1), fine = left(section, 0.05);
    for (Eigen::Index n = 0; n < coarse.size(); ++n) {
      CAPTURE(thickness, n, coarse[n], fine[n]);
      CHECK(fine[n] <= 0.3 * coarse[n] + 1e-6);
      CHECK(coarse[n] < 0.2);  // measured: 0.06; without the correction to 0.5
    }
  }
}
