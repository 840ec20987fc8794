#include "plate/galerkin/stretching.hpp"

#include <omp.h>
#include <algorithm>
#include <array>
#include <stdexcept>

namespace plate {
namespace {

using geometry::Point;

constexpr std::size_t most_members = 33;  // of a family, with its owner

/// u and v, which are theta_y and -theta_x (PlateLaw::membrane).
Point displacement(const State& membrane, std::size_t k) {
  return {membrane(2, Eigen::Index(k)), -membrane(1, Eigen::Index(k))};
}

/// One family: its owner, then its neighbours. Unknowns of a member are w, u, v; strains are the three mean strains,
/// then two residuals of every bond.
class Family {
public:
  /// Takes the strains and forces of the family of point k.
  void find(const GalerkinFamilies& families, const PointSections& sections, std::size_t k, const State& bending,
            const State& membrane);
  /// Adds what the coupling to the curvatures of the same state does to strains, forces and energy.
  void couple(const GalerkinFamilies& families, const GalerkinCoupling& coupling, std::size_t k, const State& bending);

  /// Adds the forces of a free strain, the same in all directions, that is held.
  void hold(double free) { S_ -= free * stiffness_ * Eigen::Vector3d(1, 1, 0); }
  /// Adds membrane forces times the area of the point.
  void press(const Eigen::Vector3d& forces) { S_ += forces; }

  double energy() const;
  /// Mean strains xx, yy, 2 xy.
  const Eigen::Vector3d& strains() const { return strain_; }
  /// N [force/length] times the area of the point.
  const Eigen::Vector3d& forces() const { return S_; }
  /// Writes the derivatives of the energy by w, u, v of every member [members].
  void derivative(Eigen::Vector3d* by_members) const;
  /// Writes the derivatives of the energy of coupling by the rotations theta_y, -theta_x of every member [members].
  void couples(Point* by_members) const;
  /// Second derivatives of the energy [3 members x 3 members].
  const Eigen::MatrixXd& second_derivative();
  /// Second derivatives of the energy of coupling by w, u, v (rows) and by rotations, which stand in the columns of u
  /// and v [3 members x 3 members]. After second_derivative().
  const Eigen::MatrixXd& second_derivative_of_coupling();
  /// Second derivative by two deflections alone, with the slopes at zero.
  double geometric(std::size_t i, std::size_t j) const;

private:
  struct OfBond {
    Point n{0, 0}, residual{0, 0}, force{0, 0};
    double inverse = 0, slope = 0, mean_slope = 0;  // 1 / length, (w_j - w_k) / length, n . g
    Eigen::Matrix2d stiffness = Eigen::Matrix2d::Zero();
    Point turn{0, 0}, couple{0, 0};  // residual of the rotations, and what the coupling does to it
    Eigen::Matrix2d coupling = Eigen::Matrix2d::Zero();
  };
  void differentiate();
  /// Share of a member in the difference along bond b, over its length.
  double difference(std::size_t b, std::size_t i) const {
    return i == 0 ? -bonds_[b].inverse : i == b ? bonds_[b].inverse : 0;
  }

  std::size_t count_ = 0;
  std::array<Point, most_members> gradient_;
  std::array<OfBond, most_members> bonds_;  // of neighbours, from 1
  Point slope_{0, 0};
  Eigen::Vector3d strain_{0, 0, 0}, S_{0, 0, 0};
  Eigen::Matrix3d stiffness_ = Eigen::Matrix3d::Zero();  // area times A
  Eigen::MatrixXd by_unknowns_, stressed_, second_;      // derivatives of the strains; times their stiffness
  Eigen::MatrixXd of_coupling_;
  bool coupled_ = false;
  Eigen::Vector3d curvature_{0, 0, 0}, moment_{0, 0, 0};  // moment: area times B epsilon
  Eigen::Matrix3d coupling_ = Eigen::Matrix3d::Zero();    // area times B
};

void Family::find(const GalerkinFamilies& families, const PointSections& sections, std::size_t k, const State& bending,
                  const State& membrane) {
  const auto family = families.families[k];
  const auto* weights = families.of(k);
  count_ = family.size() + 1;
  if (count_ > most_members) throw std::invalid_argument("a point has more than 32 neighbours");
  const double w = bending(0, Eigen::Index(k));
  const Point own = displacement(membrane, k);
  gradient_[0] = Point(0, 0), slope_ = Point(0, 0);
  Eigen::Matrix2d H = Eigen::Matrix2d::Zero();  // grad u
  for (std::size_t i = 1; i < count_; ++i) {
    const auto j = family[i - 1].neighbour;
    gradient_[i] = weights[i - 1].gradient, gradient_[0] -= gradient_[i];
    slope_ += gradient_[i] * (bending(0, Eigen::Index(j)) - w);
    H += (displacement(membrane, j) - own) * gradient_[i].transpose();
  }
  const GalerkinStiffness stiffness(sections[k], families.square(k));
  stiffness_ = families.areas[k] * stiffness.bending;
  strain_ << H(0, 0) + slope_.x() * slope_.x() / 2, H(1, 1) + slope_.y() * slope_.y() / 2,
      H(0, 1) + H(1, 0) + slope_.x() * slope_.y();
  S_ = stiffness_ * strain_;
  for (std::size_t i = 1; i < count_; ++i) {
    const auto [j, vector] = family[i - 1];
    const Point& x = families.families.vectors()[vector];
    auto& bond = bonds_[i];
    bond.inverse = 1 / x.norm(), bond.n = x * bond.inverse;
    bond.slope = (bending(0, Eigen::Index(j)) - w) * bond.inverse, bond.mean_slope = slope_.dot(bond.n);
    const double more = (bond.slope * bond.slope - bond.mean_slope * bond.mean_slope) / 2;
    bond.residual = (displacement(membrane, j) - own) * bond.inverse - H * bond.n + more * bond.n;
    bond.stiffness = weights[i - 1].share * stiffness.bending_residual * along(stiffness.bending, bond.n);
    bond.force = bond.stiffness * bond.residual;
  }
}

void Family::couple(const GalerkinFamilies& families, const GalerkinCoupling& coupling, std::size_t k,
                    const State& bending) {
  const auto family = families.families[k];
  const Point own = displacement(bending, k);
  Eigen::Matrix2d H = Eigen::Matrix2d::Zero();
  for (std::size_t i = 1; i < count_; ++i)
    H += (displacement(bending, family[i - 1].neighbour) - own) * gradient_[i].transpose();
  const Eigen::Matrix3d& B = coupling.sections[k].bending;
  coupled_ = true, coupling_ = families.areas[k] * B;
  curvature_ << H(0, 0), H(1, 1), H(0, 1) + H(1, 0);
  moment_ = coupling_ * strain_, S_ += coupling_ * curvature_;
  for (std::size_t i = 1; i < count_; ++i) {
    auto& bond = bonds_[i];
    bond.turn = (displacement(bending, family[i - 1].neighbour) - own) * bond.inverse - H * bond.n;
    bond.coupling = families.of(k)[i - 1].share * coupling.residual * along(B, bond.n);
    bond.couple = bond.coupling * bond.residual, bond.force += bond.coupling * bond.turn;
  }
}

/// With coupling half of it is in the forces already.
double Family::energy() const {
  double result = strain_.dot(S_) / 2;
  for (std::size_t b = 1; b < count_; ++b) result += bonds_[b].residual.dot(bonds_[b].force) / 2;
  if (!coupled_) return result;
  result += curvature_.dot(moment_) / 2;
  for (std::size_t b = 1; b < count_; ++b) result += bonds_[b].turn.dot(bonds_[b].couple) / 2;
  return result;
}

/// Finds the derivatives of the strains by the unknowns.
void Family::differentiate() {
  by_unknowns_.setZero(Eigen::Index(2 * count_ + 1), Eigen::Index(3 * count_));
  for (std::size_t i = 0; i < count_; ++i) {
    const Point& D = gradient_[i];
    const auto at = Eigen::Index(3 * i);
    by_unknowns_.block<3, 3>(0, at) << slope_.x() * D.x(), D.x(), 0, slope_.y() * D.y(), 0, D.y(),
        slope_.x() * D.y() + slope_.y() * D.x(), D.y(), D.x();
    for (std::size_t b = 1; b < count_; ++b) {
      const auto& bond = bonds_[b];
      const double own = difference(b, i), mean = D.dot(bond.n);
      auto by = by_unknowns_.block<2, 3>(Eigen::Index(2 * b + 1), at);
      by.col(0) = (bond.slope * own - bond.mean_slope * mean) * bond.n;
      by(0, 1) = by(1, 2) = own - mean;
    }
  }
}

/// By mean strains and residuals: D_i . (N g - sum of phi m n), (N - sum of f n) D_i and what each bond has of its
/// ends, with phi = f . n and the mean slope m along the bond.
void Family::derivative(Eigen::Vector3d* by_members) const {
  Eigen::Matrix2d N;
  N << S_[0], S_[2], S_[2], S_[1];
  Point by_slope = N * slope_;
  for (std::size_t i = 0; i < count_; ++i) by_members[i].setZero();
  for (std::size_t b = 1; b < count_; ++b) {
    const auto& bond = bonds_[b];
    const double phi = bond.force.dot(bond.n);
    by_slope -= phi * bond.mean_slope * bond.n;
    N -= bond.force * bond.n.transpose();
    const Eigen::Vector3d end = bond.inverse * Eigen::Vector3d(phi * bond.slope, bond.force.x(), bond.force.y());
    by_members[b] += end, by_members[0] -= end;
  }
  for (std::size_t i = 0; i < count_; ++i) {
    by_members[i][0] += by_slope.dot(gradient_[i]);
    by_members[i].tail<2>() += N * gradient_[i];
  }
}

void Family::couples(Point* by_members) const {
  Eigen::Matrix2d M;
  M << moment_[0], moment_[2], moment_[2], moment_[1];
  for (std::size_t i = 0; i < count_; ++i) by_members[i].setZero();
  for (std::size_t b = 1; b < count_; ++b) {
    const auto& bond = bonds_[b];
    M -= bond.couple * bond.n.transpose();
    by_members[b] += bond.inverse * bond.couple, by_members[0] -= bond.inverse * bond.couple;
  }
  for (std::size_t i = 0; i < count_; ++i) by_members[i] += M * gradient_[i];
}

double Family::geometric(std::size_t i, std::size_t j) const {
  const Point &D = gradient_[i], &E = gradient_[j];
  double result = S_[0] * D.x() * E.x() + S_[1] * D.y() * E.y() + S_[2] * (D.x() * E.y() + D.y() * E.x());
  for (std::size_t b = 1; b < count_; ++b) {
    const auto& n = bonds_[b].n;
    result += bonds_[b].force.dot(n) * (difference(b, i) * difference(b, j) - D.dot(n) * E.dot(n));
  }
  return result;
}

const Eigen::MatrixXd& Family::second_derivative() {
  differentiate();
  stressed_.resizeLike(by_unknowns_);
  stressed_.topRows<3>() = stiffness_ * by_unknowns_.topRows<3>();
  for (std::size_t b = 1; b < count_; ++b)
    stressed_.middleRows<2>(Eigen::Index(2 * b + 1)) =
        bonds_[b].stiffness * by_unknowns_.middleRows<2>(Eigen::Index(2 * b + 1));
  second_.noalias() = by_unknowns_.transpose() * stressed_;
  for (std::size_t i = 0; i < count_; ++i)
    for (std::size_t j = 0; j < count_; ++j) second_(Eigen::Index(3 * i), Eigen::Index(3 * j)) += geometric(i, j);
  return second_;
}

const Eigen::MatrixXd& Family::second_derivative_of_coupling() {
  stressed_.topRows<3>() = coupling_ * by_unknowns_.topRows<3>();
  for (std::size_t b = 1; b < count_; ++b)
    stressed_.middleRows<2>(Eigen::Index(2 * b + 1)) =
        bonds_[b].coupling * by_unknowns_.middleRows<2>(Eigen::Index(2 * b + 1));
  of_coupling_.noalias() = by_unknowns_.transpose() * stressed_;
  return of_coupling_;
}

/// Data that families are found from. `coupling`: null where there is none.
struct Stretched {
  const GalerkinFamilies& families;
  const PointSections& sections;
  const GalerkinCoupling* coupling;
  const State &bending, &membrane;

  void find(std::size_t k, Family& family) const {
    family.find(families, sections, k, bending, membrane);
    if (coupling) family.couple(families, *coupling, k, bending);
  }
};

/// Calls visit(family, k) for every point, from several threads.
template <typename Visit>
void for_each_family(const Stretched& plate, const Visit& visit) {
#pragma omp parallel
  {
    Family family;
#pragma omp for schedule(static)
    for (std::size_t k = 0; k < plate.families.areas.size(); ++k) {
      plate.find(k, family);
      visit(family, k);
    }
  }
}

/// Member of a family, and its place in it.
struct Member {
  std::uint32_t point, place;
};

/// Adds the families to a matrix of which every thread has columns of its own, so that any number of threads gives the
/// same bits. add(family, members, own): the members ascending; own(point): true of columns of this thread.
template <typename Add>
void add_families(const Stretched& plate, const Add& add) {
  const auto& families = plate.families;
  const auto points = families.areas.size();
#pragma omp parallel
  {
    const auto threads = std::size_t(omp_get_num_threads()), thread = std::size_t(omp_get_thread_num());
    const auto begin = std::uint32_t(points * thread / threads), end = std::uint32_t(points * (thread + 1) / threads);
    Family family;
    std::vector<Member> members;
    for (std::uint32_t k = 0; k < points && begin < end; ++k) {
      members.assign(1, {k, 0});
      std::uint32_t place = 0;
      for (const auto& bond : families.families[k]) members.push_back({bond.neighbour, ++place});
      std::ranges::sort(members, {}, &Member::point);
      if (members.back().point < begin || members.front().point >= end) continue;
      plate.find(k, family);
      add(family, members, [&](std::uint32_t point) { return point >= begin && point < end; });
    }
  }
}

/// Couples a point to all that share a family with it, counted from `first` on.
void couple_to_families(Column& column, const GalerkinFamilies& families, std::uint32_t k, std::uint32_t first) {
  column.couple(first + k);
  for (const auto& bond : families.families[k]) {
    column.couple(first + bond.neighbour);
    for (const auto& next : families.families[bond.neighbour]) column.couple(first + next.neighbour);
  }
}

/// Turns a block of u, v into one of theta_x = -v and theta_y = u.
Eigen::Matrix3d of_rotations(const Eigen::Matrix2d& in_plane) {
  Eigen::Matrix3d result = Eigen::Matrix3d::Zero();
  result(1, 1) = in_plane(1, 1), result(1, 2) = -in_plane(1, 0);
  result(2, 1) = -in_plane(0, 1), result(2, 2) = in_plane(0, 0);
  return result;
}

}  // namespace

Eigen::VectorXd GalerkinStretching::energies(const State& bending, const State& membrane) const {
  Eigen::VectorXd result(bending.cols());
  for_each_family({families_, sections_, coupling(), bending, membrane},
                  [&](const Family& family, std::size_t k) { result[Eigen::Index(k)] = family.energy(); });
  return result;
}

void GalerkinStretching::internal_force(const State& bending, const State& membrane, Forces& on_bending,
                                        Forces& on_membrane) const {
  const auto& f = families_.families;
  std::vector<std::size_t> first{0};
  for (std::size_t k = 0; k < families_.areas.size(); ++k) first.push_back(first.back() + f[k].size() + 1);
  std::vector<Eigen::Vector3d> found(first.back());
  std::vector<Point> turned(coupling_ ? first.back() : 0);
  for_each_family({families_, sections_, coupling(), bending, membrane}, [&](const Family& family, std::size_t k) {
    family.derivative(found.data() + first[k]);
    if (coupling_) family.couples(turned.data() + first[k]);
  });
  on_bending.setZero(unknowns_per_point, bending.cols());
  on_membrane.setZero(unknowns_per_point, membrane.cols());
#pragma omp parallel for schedule(static)
  for (std::uint32_t k = 0; k < families_.areas.size(); ++k) {
    const auto of_all = [&](const auto& of_members) {
      auto sum = of_members[first[k]];
      for (const auto& bond : f[k]) sum += of_members[first[bond.neighbour] + f[bond.neighbour].find(k) + 1];
      return sum;
    };
    const Eigen::Vector3d sum = of_all(found);
    on_bending(0, k) = -sum[0];
    on_membrane(1, k) = sum[2], on_membrane(2, k) = -sum[1];
    if (!coupling_) continue;
    const Point couple = of_all(turned);
    on_bending(1, k) = couple.y(), on_bending(2, k) = -couple.x();
  }
}

PointMatrix GalerkinStretching::stiffness(const State& bending, const State& membrane) const {
  const auto points = std::uint32_t(families_.areas.size());
  auto result = zeros(2 * std::size_t(points), [&](Column& column, std::uint32_t k) {
    if (k < points) couple_to_families(column, families_, k, 0);
    couple_to_families(column, families_, k % points, points);
  });
  const auto to = [&](std::size_t& at, std::uint32_t row) -> Eigen::Matrix3d& {
    while (result.row[at] != row) ++at;
    return result.block[at];
  };
  const auto add = [&](Family& family, const std::vector<Member>& members, const auto& own) {
    const auto& all = family.second_derivative();
    for (const auto& column : members) {
      if (!own(column.point)) continue;
      auto of_plate = result.first[column.point], in_plane = result.first[points + column.point];
      const auto of = [&](const Member& row) -> Eigen::Matrix3d {
        return all.block(Eigen::Index(3 * row.place), Eigen::Index(3 * column.place), 3, 3);
      };
      for (const auto& row : members) {
        if (row.point < column.point) continue;
        to(of_plate, row.point)(0, 0) += of(row)(0, 0);
        to(in_plane, points + row.point) += of_rotations(of(row).bottomRightCorner(2, 2));
      }
      for (const auto& row : members) {
        auto& block = to(of_plate, points + row.point);
        block(1, 0) -= of(row)(2, 0), block(2, 0) += of(row)(1, 0);
      }
    }
    if (!coupling_) return;
    const auto& coupled = family.second_derivative_of_coupling();
    const auto of = [&](const Member& row, const Member& column) -> Eigen::Matrix3d {
      return coupled.block(Eigen::Index(3 * row.place), Eigen::Index(3 * column.place), 3, 3);
    };
    for (const auto& column : members) {
      if (!own(column.point)) continue;
      auto at = result.first[column.point];
      for (const auto& row : members) {
        if (row.point < column.point) continue;
        const auto by_slope = of(row, column), by_turn = of(column, row);
        auto& block = to(at, row.point);
        block(0, 1) -= by_slope(0, 2), block(0, 2) += by_slope(0, 1);
        block(1, 0) -= by_turn(0, 2), block(2, 0) += by_turn(0, 1);
      }
      for (const auto& row : members)
        to(at, points + row.point) += of_rotations(of(row, column).bottomRightCorner(2, 2));
    }
  };
  add_families({families_, sections_, coupling(), bending, membrane}, add);
  return result;
}

namespace {

/// Stiffness of the deflections of a flat plate under the membrane forces of a state, and those that press(family,
/// point) adds.
template <typename Press>
PointMatrix geometric_stiffness_of(const GalerkinFamilies& families, const PointSections& sections,
                                   const State& membrane, const Press& press) {
  auto result = zeros(families.areas.size(),
                      [&](Column& column, std::uint32_t k) { couple_to_families(column, families, k, 0); });
  const auto add = [&](Family& family, const std::vector<Member>& members, const auto& own) {
    press(family, std::ranges::find(members, 0U, &Member::place)->point);
    for (const auto& column : members) {
      if (!own(column.point)) continue;
      auto at = result.first[column.point];
      for (const auto& row : members) {
        if (row.point < column.point) continue;
        while (result.row[at] != row.point) ++at;
        result.block[at](0, 0) += family.geometric(row.place, column.place);
      }
    }
  };
  const State flat = zero_state(families.areas.size());
  add_families({families, sections, nullptr, flat, membrane}, add);
  return result;
}

}  // namespace

PointMatrix GalerkinStretching::geometric_stiffness(const State& membrane) const {
  return geometric_stiffness_of(families_, sections_, membrane, [](Family&, std::uint32_t) {});
}

PointMatrix GalerkinStretching::stiffness_of_heat(const Eigen::VectorXd& free) const {
  return geometric_stiffness_of(families_, sections_, zero_state(families_.areas.size()),
                                [&](Family& family, std::uint32_t k) { family.hold(free[k]); });
}

PointMatrix GalerkinStretching::stiffness_of_forces(const Eigen::Matrix3Xd& forces) const {
  return geometric_stiffness_of(
      families_, sections_, zero_state(families_.areas.size()),
      [&](Family& family, std::uint32_t k) { family.press(families_.areas[k] * forces.col(k)); });
}

Stretch GalerkinStretching::stretch(const State& bending) const {
  const State flat = zero_like(bending);
  Stretch result{Eigen::Matrix3Xd(3, bending.cols()), {}};
  for_each_family({families_, sections_, nullptr, bending, flat},
                  [&](const Family& family, std::size_t k) { result.strains.col(Eigen::Index(k)) = family.strains(); });
  Forces ignored;
  internal_force(bending, flat, ignored, result.forces);
  return result;
}

Eigen::Matrix3Xd GalerkinStretching::membrane_forces(const State& bending, const State& membrane) const {
  Eigen::Matrix3Xd result(3, bending.cols());
  for_each_family({families_, sections_, coupling(), bending, membrane}, [&](const Family& family, std::size_t k) {
    result.col(Eigen::Index(k)) = family.forces() / families_.areas[k];
  });
  return result;
}

}  // namespace plate
