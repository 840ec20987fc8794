#include "plate/formulation/elastic_supports.hpp"

#include "tests/catch.hpp"
#include "tests/unit/plate/small_plate.hpp"

using namespace plate;
namespace sp = small_plate;

namespace {

constexpr Eigen::Index spring_points = 7;

/// Three springs, of which two share a degree of freedom.
ElasticSupports elastic_supports() {
  ElasticSupportSum first(spring_points), second(spring_points);
  first.add(4, {{dof(2, 0), 1}, {dof(5, 1), -0.5}});
  first.add(3, {{dof(2, 0), 1}});
  second.add(2, {{dof(6, 2), 1}});
  std::vector<ElasticSupport> parts;
  parts.push_back(std::move(first).taken("foundation0", {}));
  parts.push_back(std::move(second).taken("spring0", geometry::Point(1, 2)));
  return ElasticSupports(std::move(parts));
}

/// Stiffness of the elastic supports written out [3 points x 3 points].
Eigen::MatrixXd by_hand() {
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(3 * spring_points, 3 * spring_points);
  const auto at = [](Eigen::Index point, int component) {
    return Eigen::Index(index_in_state(dof(point, component), spring_points));
  };
  K(at(2, 0), at(2, 0)) = 7, K(at(5, 1), at(5, 1)) = 1;
  K(at(2, 0), at(5, 1)) = K(at(5, 1), at(2, 0)) = -2;
  K(at(6, 2), at(6, 2)) = 2;
  return K;
}

}  // namespace

TEST_CASE("attached stiffness: force, energies, diagonal and absolute product are those of its matrix") {
  const auto a = elastic_supports();
  const Eigen::MatrixXd K = by_hand();
  const State u = sp::random_state(spring_points, 3);
  const Eigen::Map<const Eigen::VectorXd> flat(u.data(), u.size());
  Forces force = Forces::Ones(3, spring_points);
  a.add_force(u, force);
  CHECK((Eigen::Map<Eigen::VectorXd>(force.data(), force.size()) + K * flat).isOnes(1e-14));
  a.take_force(u, force);
  CHECK(force.isOnes(1e-14));
  Forces diagonal = Forces::Zero(3, spring_points), absolute = diagonal;
  a.add_diagonal(diagonal);
  CHECK(Eigen::Map<Eigen::VectorXd>(diagonal.data(), diagonal.size()).isApprox(K.diagonal()));
  a.add_absolute_product(u.cwiseAbs(), absolute);
  CHECK(Eigen::Map<Eigen::VectorXd>(absolute.data(), absolute.size()).isApprox(K.cwiseAbs() * flat.cwiseAbs()));
  Eigen::VectorXd energies = Eigen::VectorXd::Zero(spring_points);
  a.add_energies(u, energies);
  CHECK(energies.sum() == Approx(flat.dot(K * flat) / 2));
  CHECK(a.energy(u) == Approx(energies.sum()));
  Values<float> single = Values<float>::Zero(3, spring_points);
  a.add_force(u.cast<float>(), single);
  CHECK((single.cast<double>().reshaped<Eigen::RowMajor>() + K * flat).norm() < 1e-6);
}

TEST_CASE("nothing attached takes nothing and does nothing") {
  const ElasticSupports none;
  Forces force = Forces::Ones(3, spring_points);
  none.add_force(force, force);
  CHECK(force.isOnes(0));
  CHECK(none.bytes() == 0);
}
