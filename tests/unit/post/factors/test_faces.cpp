// What moment and shear intensity factors are at the faces of the plate.
#include <numbers>

#include "plate/model/section.hpp"
#include "post/factors/srif.hpp"
#include "tests/catch.hpp"

namespace {

const plate::Section steel_section{200e9, 0.3, 0.02, 5.0 / 6, 0};

post::Srif factors_with_errors(double K1, double K2, double K3) {
  post::Srif srif;
  srif.K1 = K1, srif.K2 = K2, srif.K3 = K3;
  srif.errors = {std::abs(K1) / 100, std::abs(K2) / 20, std::abs(K3) / 10};
  return srif;
}

/// K_I, K_II, K_III at the height z: linear bending stress, parabolic shear stress.
std::array<double, 3> at_height(const post::FaceFactors& faces, double z) {
  const double s = 2 * z / steel_section.thickness;
  return {*faces.K[0] * s, *faces.K[1] * s, *faces.K[2] * (1 - s * s)};
}

const std::vector<std::array<double, 3>> modes{{3, 0, 0}, {0, -2, 0}, {0, 0, 50}, {-1, 2, 40}, {1, 0.5, 300}};

}  // namespace

TEST_CASE("faces: the energy over the thickness is that of the moment and shear intensity factors") {
  const double h = steel_section.thickness, E = steel_section.young, nu = steel_section.poisson;
  for (const auto& [K1, K2, K3] : modes) {
    const auto faces = post::at_faces(factors_with_errors(K1, K2, K3), steel_section, std::nullopt);
    double sum = 0;
    constexpr int slices = 2000;
    for (int i = 0; i < slices; ++i) {
      const auto K = at_height(faces, h * ((i + 0.5) / slices - 0.5));
      sum += (K[0] * K[0] + K[1] * K[1] + (1 + nu) * K[2] * K[2]) / E * h / slices;
    }
    const double pi = std::numbers::pi;  // theory (50)
    const double G = 12 * pi / (E * h * h * h) * (K1 * K1 + K2 * K2) + pi * (1 + nu) / (5.0 / 6 * E * h) * K3 * K3;
    CHECK(sum == Approx(G).epsilon(1e-5));  // of the slices
  }
}

TEST_CASE("faces: the equivalent K is the largest at any height, and its error a bound") {
  for (const auto& [K1, K2, K3] : modes) {
    const auto srif = factors_with_errors(K1, K2, K3);
    const auto faces = post::at_faces(srif, steel_section, 2e6);
    double largest = 0;
    for (int i = 0; i <= 1000; ++i) {
      const auto K = at_height(faces, steel_section.thickness * (i / 1000.0 - 0.5));
      largest = std::max(largest, std::sqrt(K[0] * K[0] + K[1] * K[1] + K[2] * K[2] / (1 - steel_section.poisson)));
    }
    CHECK(*faces.equivalent == Approx(largest).epsilon(1e-12));
    CHECK(*faces.utilisation == Approx(largest / 2e6).epsilon(1e-12));
    for (const double a : {-1, 1})
      for (const double b : {-1, 1})
        for (const double c : {-1, 1}) {
          const auto other = post::at_faces(
              factors_with_errors(K1 + a * *srif.errors[0], K2 + b * *srif.errors[1], K3 + c * *srif.errors[2]),
              steel_section, 2e6);
          CHECK(std::abs(*other.equivalent - *faces.equivalent) <= *faces.error * (1 + 1e-12));
          CHECK(std::abs(*other.utilisation - *faces.utilisation) <= *faces.utilisation_error * (1 + 1e-12));
        }
  }
}

TEST_CASE("faces: with loads in the plane both faces add up, K_eq is the largest at any height, its error a bound") {
  const double h = steel_section.thickness, root = std::sqrt(std::numbers::pi), nu = steel_section.poisson;
  const auto factors = [&](const std::array<double, 3>& K, const std::array<double, 2>& N) {
    auto srif = factors_with_errors(K[0], K[1], K[2]);
    auto& membrane = srif.membrane.emplace();
    membrane.thickness = h, membrane.N = N, membrane.resolved = {true, true};
    membrane.errors = {std::abs(N[0]) / 50, std::abs(N[1]) / 25};
    return srif;
  };
  for (const auto& K : modes)
    for (const auto& N : std::vector<std::array<double, 2>>{{700, 0}, {300, -500}, {-900, 200}, {5000, 100}}) {
      const auto srif = factors(K, N);
      const auto faces = post::at_faces(srif, steel_section, 2e6);
      CHECK(*faces.K[0] == Approx(root * (N[0] / h + 6 * K[0] / (h * h))).margin(1e-9));
      CHECK(*faces.K[1] == Approx(root * (N[1] / h + 6 * K[1] / (h * h))).margin(1e-9));
      CHECK(*(*faces.below)[0] == Approx(root * (N[0] / h - 6 * K[0] / (h * h))).margin(1e-9));
      CHECK(*(*faces.below)[1] == Approx(root * (N[1] / h - 6 * K[1] / (h * h))).margin(1e-9));
      const auto at = [&](double share) {  // faces that overlap take no energy of mode 1
        const double s = 2 * share, opening = root * (N[0] / h + 6 * s * K[0] / (h * h)),
                     sliding = root * (N[1] / h + 6 * s * K[1] / (h * h)),
                     out = root * 3 / (2 * h) * (1 - s * s) * K[2];
        return std::hypot(std::max(0.0, opening), sliding, out / std::sqrt(1 - nu));
      };
      double largest = 0;
      for (int i = 0; i <= 4000; ++i) largest = std::max(largest, at(i / 4000.0 - 0.5));
      CHECK(*faces.equivalent == Approx(largest).epsilon(1e-4));  // of its 201 heights
      CHECK(at(*faces.height) == Approx(*faces.equivalent).epsilon(1e-12));
      for (int signs = 0; signs < 32; ++signs) {
        const auto sign = [&](int i) { return (signs >> i & 1) ? 1.0 : -1.0; };
        std::array<double, 3> moved_K{};
        std::array<double, 2> moved_N{};
        for (int i = 0; i < 3; ++i)
          moved_K[std::size_t(i)] = K[std::size_t(i)] + sign(i) * *srif.errors[std::size_t(i)];
        for (int i = 0; i < 2; ++i)
          moved_N[std::size_t(i)] = N[std::size_t(i)] + sign(3 + i) * *srif.membrane->errors[std::size_t(i)];
        const auto other = post::at_faces(factors(moved_K, moved_N), steel_section, 2e6);
        CHECK(std::abs(*other.equivalent - *faces.equivalent) <= *faces.error * (1 + 1e-12));
      }
    }
}

TEST_CASE("faces: the height of the equivalent K is the face in tension, the middle plane, or between") {
  const auto height = [](double K1, double K2, double K3, double N1) {
    auto srif = factors_with_errors(K1, K2, K3);
    if (N1 != 0)
      srif.membrane = post::MembraneFactors{
          .N = {N1, 0}, .errors = {}, .resolved = {true, true}, .G = {}, .thickness = steel_section.thickness};
    return *post::at_faces(srif, steel_section, std::nullopt).height;
  };
  CHECK(height(1, 0.2, 3, 0) == 0.5);
  CHECK(height(-1, 0.2, 3, 0) == -0.5);
  CHECK(height(0.01, 0, 300, 0) == 0);
  CHECK(height(-1, 0, 0, 10) == -0.5);
  CHECK(std::abs(height(1, 0, 300, 200)) < 0.5);
}

TEST_CASE("faces: a plate in pure bending has the K of its face's stress, what is not resolved is left out") {
  // K1 = M sqrt(a): the stress 6 M / h^2 at the face of a crack of half length a has K_I = stress sqrt(pi a)
  const double M = 7, a = 0.3, h = steel_section.thickness;
  auto srif = factors_with_errors(M * std::sqrt(a), 1, 2);
  CHECK(*post::at_faces(srif, steel_section, {}).K[0] == Approx(6 * M / (h * h) * std::sqrt(std::numbers::pi * a)));
  srif.resolved = {true, false, false};
  srif.errors[1].reset(), srif.errors[2].reset();
  const auto some = post::at_faces(srif, steel_section, {});
  CHECK_FALSE(some.K[1]);
  CHECK_FALSE(some.K[2]);
  CHECK(*some.equivalent == *some.K[0]);
  CHECK(*some.error == Approx(*some.K[0] / 100));
  CHECK_FALSE(some.utilisation);
  srif.errors[2] = 50;  // a factor that is not given may be as large as this tells
  const double most = 52 * 3 / (2 * h) * std::sqrt(std::numbers::pi / (1 - steel_section.poisson));
  CHECK(*post::at_faces(srif, steel_section, {}).error == Approx(most));
  CHECK(*post::at_faces(srif, steel_section, {}).equivalent == *some.equivalent);
  srif.resolved = {false, false, false};
  CHECK_FALSE(post::at_faces(srif, steel_section, 1.0).equivalent);
  CHECK_FALSE(post::at_faces(srif, steel_section, 1.0).utilisation);
}
