#include "plate/solve/large_deflections.hpp"

#include <fmt/format.h>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "plate/formulation/boundary.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/pieces.hpp"
#include "plate/formulation/thermal_curvature.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/problem.hpp"
#include "plate/model/reduction.hpp"
#include "plate/solve/factorised_plate.hpp"
#include "plate/solve/interruption.hpp"
#include "plate/solve/stretched_contact.hpp"

namespace plate {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

/// Rigid motions of a piece in its plane, about a point, by a degree of freedom: u = theta_y, v = -theta_x.
class MotionsInPlane {
public:
  MotionsInPlane(const geometry::Point& about, double length) : about_(about), length_(length) {}

  Eigen::Vector3d row(const Dof& one, const geometry::Point& at) const {
    const geometry::Point x = (at - about_) / length_;
    if (one.component == 2) return {1, 0, -x.y()};
    if (one.component == 1) return {0, -1, -x.x()};
    return {0, 0, 0};
  }

private:
  geometry::Point about_;
  double length_;
};

/// Products of the rigid motions with those that the constraints of owned points prevent, summed over all ranks.
/// `here`: of the piece.
Eigen::Matrix3d held_motions(const Formulation& membrane, const MotionsInPlane& rigid, const std::vector<char>& here) {
  const auto& positions = membrane.cloud().positions;
  std::vector<Eigen::Vector3d> rows;
  for (const auto& fixed : membrane.constraints().fixed())
    if (here[fixed.point]) rows.push_back(rigid.row(fixed, positions[fixed.point]));
  const auto& ties = membrane.constraints().ties();
  for (std::size_t i = 0; i < ties.size();) {
    const auto follower = ties[i].follower;
    Eigen::Vector3d row = rigid.row(follower, positions[follower.point]);
    for (; i < ties.size() && ties[i].follower == follower; ++i)
      row -= ties[i].factor * rigid.row(ties[i].leader, positions[ties[i].leader.point]);
    if (here[follower.point]) rows.push_back(row);
  }
  const auto sums = sum_of_items<9>(membrane, rows.size(), [&](std::size_t i, const auto& add) {
    for (Eigen::Index n = 0; n < 9; ++n) add(std::size_t(n), rows[i][n / 3] * rows[i][n % 3]);
  });
  return Eigen::Map<const Eigen::Matrix3d>(sums.data());
}

/// A degree of freedom that could be pinned. Between those that are alike the first in the order of the global plate is
/// taken.
struct Pin {
  double moved;  // by the motion that it prevents
  std::array<double, 2> place;
  int rank;
  Dof dof;
  std::array<double, 3> row;  // MotionsInPlane
};

/// The best of the pins that every rank has found.
std::optional<Pin> best_of_ranks(const Formulation& membrane, const std::optional<Pin>& own) {
  constexpr double alike = 1 + 1e-9;
  auto all = gathered(membrane, own ? std::vector{*own} : std::vector<Pin>());
  if (all.empty()) return std::nullopt;
  const double most = std::ranges::max_element(all, {}, &Pin::moved)->moved;
  std::erase_if(all, [&](const Pin& pin) { return pin.moved * alike < most; });
  return *std::ranges::min_element(all, {}, &Pin::place);
}

/// Degrees of freedom of this rank that hold a piece in its plane as its supports do not. `points`: owned ones.
/// Collective.
std::vector<Dof> pins_of(const std::vector<std::uint32_t>& points, const Formulation& membrane) {
  constexpr double none = 1e-6;
  const auto& positions = membrane.cloud().positions;
  const auto& map = membrane.boundary().map;
  const auto count = double(count_of_all(membrane, std::int64_t(points.size())));
  const auto [x, y] = sum_of_items<2>(membrane, points.size(), [&](std::size_t i, const auto& add) {
    for (const int axis : {0, 1}) add(std::size_t(axis), positions[points[i]][axis] / count);
  });
  const geometry::Point centre(x, y);
  double length = 0;
  for (const auto k : points) length = std::max(length, (positions[k] - centre).norm());
  length = largest_of(membrane, length);
  const MotionsInPlane rigid(centre, length > 0 ? length : 1);
  std::vector<char> here(positions.size(), 0);
  for (const auto k : points) here[k] = 1;
  Eigen::Matrix3d held = held_motions(membrane, rigid, here);
  std::vector<Dof> result;
  for (int pins = 0;; ++pins) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> motions(held);
    if (pins == 3 || motions.eigenvalues()[0] > none) return result;
    const Eigen::Vector3d motion = motions.eigenvectors().col(0);
    std::optional<Pin> own;
    for (const auto k : points)
      for (const int component : {1, 2}) {
        const auto one = dof(k, component);
        const Eigen::Vector3d row = rigid.row(one, positions[k]);
        const double moved = std::abs(row.dot(motion)), most = own ? own->moved : 0;
        if (!(moved > most * (1 + 1e-9)) || membrane.constraints().held(one)) continue;
        const auto& at = membrane.boundary().lattice[k];
        own = {.moved = moved,
               .place = map.global.empty() ? std::array{at.y(), at.x()} : std::array{double(map.global[k]), 0.0},
               .rank = map.rank(),
               .dof = one,
               .row = {row[0], row[1], row[2]}};
      }
    const auto best = best_of_ranks(membrane, own);
    if (!best) return result;
    const auto row = Eigen::Map<const Eigen::Vector3d>(best->row.data());
    held += row * row.transpose();
    if (best->rank == map.rank()) result.push_back(best->dof);
  }
}

/// Pins of all pieces that this rank owns.
std::vector<Dof> pins_of(const Formulation& membrane) {
  if (membrane.held()) return {};
  if (membrane.distributed()) {  // of one piece: others that nothing holds are refused
    std::vector<std::uint32_t> owned;
    for (std::uint32_t k = 0; k < membrane.points(); ++k)
      if (membrane.boundary().owns(k) && membrane.families()[k].size() > 0) owned.push_back(k);
    return pins_of(owned, membrane);
  }
  DisjointSets sets(membrane.points());
  for (std::uint32_t k = 0; k < membrane.points(); ++k)
    for (const auto& bond : membrane.families()[k]) sets.join(k, bond.neighbour);
  for (const auto& tie : membrane.constraints().ties())
    sets.join(tie.follower.point, tie.leader.point);  // a hub's disc
  membrane.boundary().elastic_supports.for_each_joined([&](std::uint32_t k, std::uint32_t j) { sets.join(k, j); });
  std::vector<std::vector<std::uint32_t>> pieces(membrane.points());
  for (std::uint32_t k = 0; k < membrane.points(); ++k) pieces[sets.root(k)].push_back(k);
  std::vector<Dof> result;
  for (const auto& piece : pieces)
    if (!piece.empty()) std::ranges::copy(pins_of(piece, membrane), std::back_inserter(result));
  return result;
}

/// The diagonal of a folded matrix, zero at held degrees of freedom.
Forces free_diagonal(const PointMatrix& matrix, const Constraints& constraints) {
  Forces result = zero_forces(matrix.points());
  for (std::size_t k = 0; k < matrix.points(); ++k)
    result.col(Eigen::Index(k)) = matrix.block[matrix.first[k]].diagonal();
  for (const auto& held : constraints.held()) at_dof(result, held) = 0;
  return result;
}

/// Work of forces, which are not folded, on a state, over all ranks.
double work(const Formulation& plate, const Forces& forces, const State& state) {
  return plate.sum_of_points(forces.cwiseProduct(state).colwise().sum().transpose());
}

/// Displacement of the loads of a plate and of its plane: minus their potential, by their factor. The heat's is not
/// linear in the deflections.
double displacement_of(const Formulation& plate, const PlateLoads& loads, const State& bending, const State& membrane) {
  const double linear = work(plate, loads.across, bending) + work(plate, loads.in_plane, membrane);
  return loads.heat.points() == 0 ? linear : linear - work(plate, product(loads.heat, bending), bending) / 2;
}

/// Largest value of the points that any rank owns; ghosts may be those of an earlier state.
double largest_of_points(const Formulation& plate, const Eigen::RowVectorXd& values) {
  double result = 0;
  for (Eigen::Index k = 0; k < values.size(); ++k)
    if (plate.boundary().owns(std::size_t(k))) result = std::max(result, values[k]);
  return largest_of(plate, result);
}

/// The first point that has a value, at the first rank that owns such a point; -1 elsewhere.
Eigen::Index first_at(const Formulation& plate, const Eigen::RowVectorXd& values, double wanted) {
  Eigen::Index here = 0;
  while (here < values.size() && !(plate.boundary().owns(std::size_t(here)) && values[here] == wanted)) ++here;
  const bool found = here < values.size();
  const double rank = plate.communicator().rank(), first = -largest_of(plate, found ? -rank : -INFINITY);
  return found && rank == first ? here : -1;
}

double largest_deflection(const Formulation& plate, const State& bending) {
  return largest_of_points(plate, bending.row(0).cwiseAbs());
}

/// The solution of a factor for folded forces.
State solution(const Factor& factor, const Unknowns& unknowns, const Forces& force) {
  const Eigen::MatrixXd found = factor.solve(gathered(unknowns, force));
  State result = zero_like(force);
  for (Eigen::Index u = 0; u < found.rows(); ++u) at_dof(result, unknowns.dof[std::size_t(u)]) = found(u, 0);
  return result;
}

/// Displacements of a plate and its plane by forces on both.
State displacements(const Factor& factor, const Unknowns& unknowns, const Constraints& constraints, Forces forces) {
  constraints.fold(forces);
  State result = solution(factor, unknowns, forces);
  constraints.impose(result);
  return result;
}

/// The loads that grow, by their factor: heat in the plane presses the more, the more the plate deflects.
PlateLoads by_factor(const PlateLoads& loads, const State& bending) {
  PlateLoads result{loads.across, loads.in_plane};
  if (loads.heat.points() > 0) result.across -= product(loads.heat, bending);
  return result;
}

/// Energy that heat in the plane stores by the deflections under a share of the loads.
double stored_by_deflections(const Formulation& plate, const PlateLoads& loads, double share, const State& bending) {
  const auto of = [&](const PlateLoads& some) {
    return some.heat.points() > 0 ? work(plate, product(some.heat, bending), bending) / 2 : 0;
  };
  return share * of(loads) + (loads.constant ? of(*loads.constant) : 0);
}

/// Integral of one function over another between the ends of a step, of both cubic in its length; `by`: derivatives.
double integral(const std::array<double, 2>& of, const std::array<double, 2>& of_by, const std::array<double, 2>& over,
                const std::array<double, 2>& over_by, double length) {
  const double more = of[1] - of[0], moved = over[1] - over[0];
  return (of[0] + of[1]) / 2 * moved +
         length * (more * (over_by[1] - over_by[0]) - moved * (of_by[1] - of_by[0])) / 10 -
         length * length * (of_by[0] * over_by[1] - of_by[1] * over_by[0]) / 60;
}

}  // namespace

PointMatrix with_first(const PointMatrix& of_first, const PointMatrix& of_all) {
  const auto each_row = [](const PointMatrix& matrix, std::size_t k, const auto& visit) {
    if (k >= matrix.points()) return;
    for (auto b = matrix.first[k]; b < matrix.first[k + 1]; ++b) visit(b);
  };
  auto result = zeros(of_all.points(), [&](Column& column, std::uint32_t k) {
    for (const auto* matrix : {&of_first, &of_all})
      each_row(*matrix, k, [&](std::size_t b) { column.couple(matrix->row[b]); });
  });
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < result.points(); ++k)
    for (const auto* matrix : {&of_first, &of_all}) {
      auto at = result.first[k];
      each_row(*matrix, k, [&](std::size_t b) {
        while (result.row[at] != matrix->row[b]) ++at;
        result.block[at] += matrix->block[b];
      });
    }
  return result;
}

Constraints pinned(const Formulation& membrane) {
  return membrane.constraints_about().fixing(pins_of(membrane));
}

PointMatrix Formulation::stiffness() const {
  throw std::logic_error("a stiffness was asked of a formulation that does not offer it");
}

std::unique_ptr<Stretching> Formulation::stretching() const {
  throw std::logic_error("large deflections were asked of a formulation that does not offer them");
}

std::unique_ptr<Formulation> Formulation::middle_plane() const {
  throw std::logic_error("the plane was asked of a formulation that does not offer it");
}

bool LargeDeflections::snapped() const {
  return std::ranges::any_of(steps, &LoadStep::snapped);
}

MiddlePlane::MiddlePlane(const Formulation& membrane, const Forces& bending)
    : stretching_(membrane.stretching()), constraints_(pinned(membrane)) {
  const auto stiffness = folded(membrane.stiffness(), constraints_);
  diagonal_ = free_diagonal(stiffness, constraints_);
  if (membrane.distributed()) {
    unknowns_ = owned_unknowns(membrane.boundary(), membrane.points());
    factor_ = distributed_factor(stiffness, membrane.boundary(), constraints_, diagonal_);
    return;
  }
  order_ = elimination_order(stiffness, bending.cols() > 0 ? Forces(diagonal_ + bending) : diagonal_);
  unknowns_ = unknowns(diagonal_, order_);
  factor_ = factorised(of_unknowns(stiffness, unknowns_));
}

/// Linear in the load and in the squares of the slopes.
State MiddlePlane::displacements(const State& bending, const Forces& load) const {
  Forces on_bending, force;
  stretching_->internal_force(bending, zero_like(bending), on_bending, force);
  force += load;
  constraints_.fold(force);
  State result = solution(*factor_, unknowns_, force);
  constraints_.impose(result);
  return result;
}

std::vector<State> MiddlePlane::solve(const std::vector<Forces>& loads) const {
  return solutions(*factor_, unknowns_, constraints_, loads);
}

namespace {

/// The positive root of a s + b s^3 = 1, b >= 0; infinite where there is none.
double scale_of_least_energy(double a, double b) {
  constexpr int most = 100;
  constexpr double close = 1e-12;
  if (b <= 0) return a > 0 ? 1 / a : INFINITY;
  const double by_stretching = std::cbrt(1 / b);
  // the left side is convex and above 1 here, so that Newton's steps go down to the root
  double s = a > 0 ? std::min(1 / a, by_stretching) : std::sqrt(-a / b) + by_stretching;
  for (int i = 0; i < most; ++i) {
    const double step = (a * s + b * s * s * s - 1) / (a + 3 * b * s * s);
    s -= step;
    if (std::abs(step) <= close * s) break;
  }
  return s;
}

}  // namespace

PointMatrix stiffness_of_heat(const Formulation& membrane, const Heat& heat) {
  if (heat.none()) return {};
  const auto stretching = membrane.stretching();
  return heat.beside.size() > 0 ? stretching->stiffness_of_forces(-held_forces(membrane.section(), heat))
                                : stretching->stiffness_of_heat(heat.curvature);
}

double linear_theory_off(const Formulation& plate, const Formulation& membrane, const State& bending,
                         const PlateLoads& loads) {
  const double bent = plate.strain_energy(bending);
  if (!(bent > 0)) return 0;
  const MiddlePlane plane(membrane);
  const State displacements = plane.displacements(bending, zero_like(bending));
  const double stretched = membrane.sum_of_points(plane.stretching().energies(bending, displacements));
  const double by_load =
      -displacement_of(plate, {zero_like(bending), loads.in_plane, loads.heat}, bending, displacements);
  return 1 / scale_of_least_energy(1 + by_load / bent, 2 * stretched / bent) - 1;
}

/// A state with its membrane in equilibrium, under a share of the loads.
struct StretchedPlate::Now {
  State bending, membrane;
  Forces on_bending;              // of the stretched middle plane
  Forces left;                    // of all forces on the plate, folded
  Eigen::VectorXd on_faces = {};  // contact forces on the rows of StretchedContact; empty where none may touch
  double bending_energy = 0, membrane_energy = 0;  // that of the coupling among the latter
  double potential = 0, residual = 0;

  double energy() const { return bending_energy + membrane_energy + potential; }
};

StretchedPlate::StretchedPlate(const Formulation& plate, const Formulation& membrane)
    : plate_(plate),
      bending_(plate.stiffness()),
      diagonal_(free_diagonal(folded(bending_, plate.constraints()), plate.constraints())),
      plane_(membrane, diagonal_),
      weight_(diagonal_.unaryExpr([](double d) { return d > 0 ? 1 / d : 0.0; })) {
  const auto points = std::uint32_t(plate.points());
  of_both_ =
      stacked(plate.distributed() ? plate.constraints_about() : plate.constraints(), plane_.constraints(), points);
  if (plate.distributed()) {
    unknowns_ = owned_unknowns(plate.boundary(), 2 * plate.points());
  } else {  // the unknowns of a point and of the same point in its plane stand together
    std::vector<int> both;
    for (const int k : plane_.order()) both.push_back(k), both.push_back(int(points) + k);
    unknowns_ = unknowns(stacked(diagonal_, plane_.diagonal()), both);
  }
  if (!plate.problem().faces_touch()) return;
  contact_ = std::make_unique<StretchedContact>(plate, plane_);
  if (contact_->rows().pairs().empty()) contact_.reset();
}

StretchedPlate::~StretchedPlate() = default;

double StretchedPlate::norm(const Forces& forces) const {
  return std::sqrt(sum_of_all(plate_, (forces.array().square() * weight_.array()).sum()));
}

/// `on_faces`: an estimate of the contact forces.
StretchedPlate::Now StretchedPlate::at(const PlateLoads& loads, const State& bending, double factor,
                                       const Eigen::VectorXd& on_faces) const {
  Forces in_plane = factor * loads.in_plane;
  if (loads.constant) in_plane += loads.constant->in_plane;
  Now now{bending, plane_.displacements(bending, in_plane), {}, {}};
  if (contact_) now.on_faces = contact_->part(now.bending, now.membrane, on_faces);
  Forces on_membrane;
  plane_.stretching().internal_force(now.bending, now.membrane, now.on_bending, on_membrane);
  if (loads.heat.points() > 0) now.on_bending -= factor * product(loads.heat, now.bending);
  if (loads.constant && loads.constant->heat.points() > 0) now.on_bending -= product(loads.constant->heat, now.bending);
  plate_.internal_force(now.bending, now.left);
  now.left += now.on_bending + factor * loads.across;
  if (loads.constant) now.left += loads.constant->across;
  if (contact_) contact_->rows().press(now.on_faces, now.left, on_membrane);
  plate_.constraints().fold(now.left);
  now.bending_energy = plate_.strain_energy(now.bending);
  now.membrane_energy = plate_.sum_of_points(plane_.stretching().energies(now.bending, now.membrane));
  now.potential = -factor * displacement_of(plate_, loads, now.bending, now.membrane);
  if (loads.constant) now.potential -= displacement_of(plate_, *loads.constant, now.bending, now.membrane);
  now.residual = norm(now.left);
  if (!std::isfinite(now.energy()) || !std::isfinite(now.residual))
    throw NumericalError(fmt::format("large deflections: not finite at a load factor of {:.3g}", factor));
  return now;
}

/// The stiffness there, folded.
PointMatrix StretchedPlate::stiffness(const Now& now, const PlateLoads& loads, double factor) const {
  State both = stacked(now.bending, now.membrane);
  if (plate_.distributed()) of_both_.impose(both);  // of all that the stiffness looks at
  auto matrix = with_first(bending_, plane_.stretching().stiffness(of_plate(both), of_plane(both)));
  if (loads.heat.points() > 0) add(loads.heat, factor, matrix);
  if (loads.constant && loads.constant->heat.points() > 0) add(loads.constant->heat, 1, matrix);
  return folded(std::move(matrix), of_both_);
}

/// The factor of the stiffness there, with the least share of its diagonal that makes it positive.
std::unique_ptr<Factor> StretchedPlate::tangent(const Now& now, const PlateLoads& loads, double factor,
                                                double& shift) const {
  constexpr double first = 1e-4, growth = 10, most = 1e4;
  auto matrix = stiffness(now, loads, factor);
  const bool shared = plate_.distributed();
  const auto lower = shared ? Matrix() : of_unknowns(matrix, unknowns_);
  if (!shared) matrix = {};
  const auto factorised = [&] {
    return shared
               ? distributed_factor(matrix, plate_.boundary(), of_both_, stacked(diagonal_, plane_.diagonal()), shift)
               : std::make_unique<Factor>(lower, shift);
  };
  for (shift = 0;; shift = shift == 0 ? first : growth * shift) try {
      return factorised();
    } catch (const NumericalError&) {
      if (shift > most) throw;
    }
}

/// A change of a plate: of its deflections, of the displacements in the plane that follow, and of the contact forces.
struct StretchedPlate::Way {
  State bending, membrane;
  Eigen::VectorXd on_faces = {};
};

/// Adds what a change of the contact forces does to the plate and its plane.
void StretchedPlate::add_contact(const Factor& tangent, const Eigen::VectorXd& change, State& both) const {
  Forces on_bending = zero_forces(plate_.points()), on_plane = on_bending;
  contact_->rows().press(change, on_bending, on_plane);
  both += solutions(tangent, unknowns_, of_both_, {stacked(on_bending, on_plane)}).front();
}

/// Newton's step by a tangent; with contact the one of least energy without overlap.
StretchedPlate::Way StretchedPlate::step(const Factor& tangent, const Now& now) const {
  State both = solution(tangent, unknowns_, stacked(now.left, zero_like(now.left)));
  if (!contact_) {
    State bending = of_plate(both);
    plate_.constraints().impose(bending);
    return {std::move(bending), {}};
  }
  of_both_.impose(both);
  const auto solve = [&](const auto& loads) { return solutions(tangent, unknowns_, of_both_, loads); };
  const State bending = now.bending + of_plate(both), membrane = now.membrane + of_plane(both);
  auto on_faces = contact_->forces({bending, membrane, now.on_faces, {}, {}}, solve);
  add_contact(tangent, on_faces - now.on_faces, both);
  return {of_plate(both), of_plane(both), std::move(on_faces)};
}

/// Change of an equilibrium by the load factor; with contact rows that are pressed stay closed.
StretchedPlate::Way StretchedPlate::rate(const Factor& tangent, const Now& now, const PlateLoads& loads) const {
  Forces all = stacked(loads.across, loads.in_plane);
  of_both_.fold(all);
  State both = solution(tangent, unknowns_, all);
  of_both_.impose(both);
  if (!contact_) return {of_plate(both), of_plane(both)};
  const auto solve = [&](const auto& some) { return solutions(tangent, unknowns_, of_both_, some); };
  const auto& rows = contact_->rows();
  const auto openings = rows.openings(now.bending, now.membrane);
  const double error = rows.error_of_openings(now.bending, now.membrane);
  std::vector<char> pressed, open;
  for (Eigen::Index i = 0; i < openings.size(); ++i) {
    pressed.push_back(now.on_faces[i] > 0);
    open.push_back(!pressed.back() && openings[i] > error);
  }
  const State bending = of_plate(both), membrane = of_plane(both);
  auto on_faces = contact_->forces({bending, membrane, Eigen::VectorXd::Zero(openings.size()), pressed, open}, solve);
  add_contact(tangent, on_faces, both);
  return {of_plate(both), of_plane(both), std::move(on_faces)};
}

/// The residual relative to the loads across the plate or to the forces of its middle plane.
double StretchedPlate::residual(const Now& now, const PlateLoads& loads, double factor) const {
  Forces load = factor * loads.across, stretched = now.on_bending;
  if (loads.constant) load += loads.constant->across;
  plate_.constraints().fold(load), plate_.constraints().fold(stretched);
  double scale = std::max(norm(load), norm(stretched));
  if (loads.constant) {  // what grows may take it back
    Forces constant = loads.constant->across;
    plate_.constraints().fold(constant), scale = std::max(scale, norm(constant));
  }
  return scale > 0 ? now.residual / scale : 0;
}

/// Newton's iteration at the load factor of a step, each way as far as it lowers the energy.
bool StretchedPlate::iterate(Now& now, const PlateLoads& loads, const LargeDeflectionOptions& options,
                             LoadStep& step) const {
  constexpr std::size_t most = 30;
  constexpr int halvings = 10;
  constexpr double rounding = 1e-13;
  for (step.iterations = 0;; ++step.iterations) {
    stop_if_asked("large deflections", plate_.constraints());
    step.residual = residual(now, loads, step.factor);
    if (options.progress) options.progress(step.factor, step.iterations, step.residual);
    if (step.residual <= options.tolerance) return true;
    if (step.iterations == most) return false;
    double shift = 0;
    const auto inverse = tangent(now, loads, step.factor, shift);
    step.snapped = step.snapped || shift > 0;
    const Way way = this->step(*inverse, now);
    double share = 1;
    for (int n = 0;; ++n, share /= 2) {
      Now next = at(loads, now.bending + share * way.bending, step.factor, way.on_faces);
      const double room = rounding * (now.bending_energy + now.membrane_energy + std::abs(now.potential));
      if (next.energy() <= now.energy() + room || next.residual < now.residual / 2) {
        now = std::move(next);
        break;
      }
      if (n == halvings) return false;
    }
  }
}

/// The plate as its loads grow.
struct StretchedPlate::Path {
  const PlateLoads* loads;
  Now now;
  double factor = 0, step = 1;  // of the loads
  Way rate;                     // by the factor
  double along = 0;             // of the displacement of the loads
  double work = 0;              // of the loads
  std::size_t bytes = 0;        // of the stiffness
  bool stable = true;
  // by arc length
  std::size_t unstable_modes = 0;
  double length = 0;        // so far
  bool deflected = false;   // already
  Eigen::Index point = -1;  // whose deflection is told; -1: none, or that of another rank

  /// With what heat stores.
  double strain_energy(const Formulation& plate) const {
    const double strained = now.bending_energy + now.membrane_energy;
    return !loads->stored ? strained
                          : strained + loads->stored(factor, now.bending, now.membrane) +
                                stored_by_deflections(plate, *loads, factor, now.bending);
  }
};

/// Finds how the plate goes on from where it is.
void StretchedPlate::look_ahead(Path& path) const {
  double shift = 0;
  const auto inverse = tangent(path.now, *path.loads, path.factor, shift);
  const auto loads = by_factor(*path.loads, path.now.bending);
  path.rate = rate(*inverse, path.now, loads);
  path.along = displacement_of(plate_, loads, path.rate.bending, path.rate.membrane);
  path.bytes = inverse->bytes(), path.stable = shift == 0;
}

/// Work of the loads from one equilibrium to the next, by Hermite's rule over the displacement of the loads: exact
/// where they grow with its third power, as with the stretching of a plate. Where hardly anything moves the loads
/// before, as heat does not until the plate buckles, the line of the end.
double StretchedPlate::work_between(const Path& before, const Path& after) const {
  const double moved = displacement_of(plate_, *after.loads, after.now.bending, after.now.membrane) -
                       displacement_of(plate_, *after.loads, before.now.bending, before.now.membrane);
  const double mean = moved * (before.factor + after.factor) / 2;
  if (!(before.along > 0) || !(after.along > 0)) return mean;
  const double hermite = mean + moved * moved * (1 / before.along - 1 / after.along) / 12;
  const double least = before.factor * moved, most = after.factor * moved;
  return moved > 0 && hermite > most ? std::max(least, most - moved * moved / (2 * after.along)) : hermite;
}

/// Work of the constant loads from one equilibrium to the next.
double StretchedPlate::work_of_constant(const Path& before, const Path& after) const {
  const auto* loads = after.loads->constant;
  if (!loads) return 0;
  return displacement_of(plate_, *loads, after.now.bending, after.now.membrane) -
         displacement_of(plate_, *loads, before.now.bending, before.now.membrane);
}

/// Finds the next equilibrium; false where there is none within the least step.
bool StretchedPlate::advance(Path& path, const LargeDeflectionOptions& options, LargeDeflections& result) const {
  constexpr double least = 1e-4, usual = 5;  // step of the factor; iterations
  for (;; path.step /= 4) {
    if (path.step < least) return false;
    LoadStep step;
    step.factor = path.factor + path.step > 1 - least ? 1 : path.factor + path.step;
    const double length = step.factor - path.factor;
    Eigen::VectorXd on_faces;
    if (contact_) on_faces = path.now.on_faces + length * path.rate.on_faces;
    Now next = at(*path.loads, path.now.bending + length * path.rate.bending, step.factor, on_faces.cwiseMax(0));
    const bool found = iterate(next, *path.loads, options, step);
    result.iterations += step.iterations;
    if (!found) continue;
    step.largest_deflection = largest_deflection(plate_, next.bending);
    const Path before = path;
    path.now = std::move(next), path.factor = step.factor;
    step.strain_energy = path.strain_energy(plate_);
    look_ahead(path);
    step.stable = path.stable;
    path.work += work_between(before, path) + work_of_constant(before, path);
    path.step = length * std::clamp(usual / double(step.iterations + 1), 0.5, 3.0);
    result.steps.push_back(step);
    return true;
  }
}

/// The plate before it is loaded.
StretchedPlate::Now StretchedPlate::undeformed(const PlateLoads& loads) const {
  Eigen::VectorXd on_faces;
  if (contact_) on_faces = Eigen::VectorXd::Zero(2 * contact_->rows().arms().size());
  return at(loads, zero_like(loads.across), 0, on_faces);
}

/// Lets the loads grow by their factor as far as equilibria are found.
void StretchedPlate::grow(Path& path, const LargeDeflectionOptions& options, LargeDeflections& result) const {
  constexpr double far = 2;  // thicknesses, of the first step by linear theory
  look_ahead(path);
  const double linear = largest_deflection(plate_, path.rate.bending);
  if (linear > 0) path.step = std::min(1.0, far * plate_.section().thickness / linear);
  while (path.factor < 1 && advance(path, options, result)) {
  }
  if (path.factor < 1 && result.steps.empty())
    result.stop_reason = fmt::format(
        "no equilibrium found beyond {:.4g} of the loads, which deflect the plate by {:.2g} thicknesses in linear "
        "theory: reduce them",
        path.factor, linear / plate_.section().thickness);
}

/// A direction of the path of equilibria, of the length 1: squares are the mean of (w / thickness)^2 over the points
/// and the load factor squared.
struct StretchedPlate::Arc {
  State bending;
  double factor = 1;
  double moved = 0;  // displacement of the loads that grow
  double step = 0;   // next one, of the length of the path
};

/// Scalar product of a direction of the path and another one, over all ranks.
double StretchedPlate::along(const Arc& arc, const State& bending, double factor) const {
  const double h = plate_.section().thickness;
  const auto points = plate_.sum_of_points(Eigen::VectorXd::Ones(bending.cols()));
  const auto squares = plate_.sum_of_points(arc.bending.row(0).cwiseProduct(bending.row(0)).transpose());
  return squares / (h * h * points) + arc.factor * factor;
}

/// The factor of the stiffness at a state of a path.
/// @throws NumericalError  where it is singular
std::unique_ptr<Factor> StretchedPlate::inverse_of_any_sign(const Path& path) const {
  auto matrix = stiffness(path.now, *path.loads, path.factor);
  if (plate_.distributed())
    return distributed_factor_of_any_sign(std::move(matrix), plate_.boundary(), of_both_,
                                          stacked(diagonal_, plane_.diagonal()));
  return std::make_unique<Factor>(Factor::of_any_sign(of_unknowns(matrix, unknowns_)));
}

/// The direction of the path from an equilibrium on, the way that another one went.
StretchedPlate::Arc StretchedPlate::look_along(Path& path, const Arc& before) const {
  const auto inverse = inverse_of_any_sign(path);
  const auto loads = by_factor(*path.loads, path.now.bending);
  const State both = displacements(*inverse, unknowns_, of_both_, stacked(loads.across, loads.in_plane));
  Arc result{of_plate(both)};
  result.moved = displacement_of(plate_, loads, result.bending, of_plane(both));
  const double length = std::sqrt(along(result, result.bending, 1));
  const double share = (along(before, result.bending, 1) < 0 ? -1 : 1) / length;
  result.bending *= share, result.factor = share, result.moved *= share, result.step = before.step;
  path.bytes = inverse->bytes(), path.unstable_modes = inverse->negative(), path.stable = path.unstable_modes == 0;
  return result;
}

/// Newton's iteration in the plane through the state of a path that is normal to a direction.
bool StretchedPlate::correct(Path& path, const Arc& normal, const LargeDeflectionOptions& options,
                             LoadStep& step) const {
  constexpr std::size_t most = 12;
  constexpr double beyond = 1e3;  // the first residual
  for (double first = 0;; ++step.iterations) {
    stop_if_asked("large deflections", plate_.constraints());
    step.residual = residual(path.now, *path.loads, path.factor);
    if (options.progress) options.progress(path.factor, step.iterations, step.residual);
    if (step.residual <= options.tolerance) return true;
    if (first == 0) first = step.residual;
    if (step.iterations >= most || !(step.residual < beyond * first)) return false;
    State change, by_load;
    try {
      const auto inverse = inverse_of_any_sign(path);
      const auto solve = [&](const Forces& across, const Forces& in_plane) {
        return of_plate(displacements(*inverse, unknowns_, of_both_, stacked(across, in_plane)));
      };
      const auto loads = by_factor(*path.loads, path.now.bending);
      change = solve(path.now.left, zero_like(path.now.left)), by_load = solve(loads.across, loads.in_plane);
    } catch (const NumericalError&) {
      return false;  // singular: a shorter step ends elsewhere
    }
    const double more = -along(normal, change, 0) / along(normal, by_load, 1);
    if (!std::isfinite(more)) return false;
    path.factor += more;
    path.now = at(*path.loads, path.now.bending + change + more * by_load, path.factor, {});
  }
}

/// Work of the loads from one equilibrium of a path to the next: of those that grow by the integral of their factor, of
/// constant ones exactly.
double StretchedPlate::work_along(const Path& before, const Path& after, const Arc& first, const Arc& last) const {
  const auto& loads = *before.loads;
  const auto of = [&](const PlateLoads& some, const Path& path) {
    return displacement_of(plate_, some, path.now.bending, path.now.membrane);
  };
  return work_of_constant(before, after) + integral({before.factor, after.factor}, {first.factor, last.factor},
                                                    {of(loads, before), of(loads, after)}, {first.moved, last.moved},
                                                    after.length - before.length);
}

/// The extreme load factor between two equilibria of a path, cubic in its length; none where the factor only grows or
/// falls.
std::optional<double> StretchedPlate::limit_between(const Path& before, const Path& after, const Arc& first,
                                                    const Arc& last) const {
  if (first.factor * last.factor >= 0) return std::nullopt;
  const double length = after.length - before.length, more = after.factor - before.factor;
  const double a = length * first.factor, c = a + length * last.factor - 2 * more, b = more - a - c;
  const double t = -a / (b - std::copysign(std::sqrt(b * b - 3 * a * c), a));
  return before.factor + t * (a + t * (b + t * c));
}

/// Records an equilibrium of the path.
void StretchedPlate::add_step(Path& path, LoadStep& step, LargeDeflections& result) const {
  const auto deflections = path.now.bending.row(0);
  step.factor = path.factor, step.stable = path.stable, step.arc_length = path.length;
  step.unstable_modes = path.unstable_modes;
  step.strain_energy = path.strain_energy(plate_);
  step.largest_deflection = plate::largest_deflection(plate_, path.now.bending);
  if (!path.deflected && step.largest_deflection > 0) {
    path.deflected = true;
    path.point = first_at(plate_, deflections.cwiseAbs(), step.largest_deflection);
  }
  step.deflection = sum_of_all(plate_, path.point >= 0 ? deflections[path.point] : 0);
  result.steps.push_back(step);
}

/// Applies the constant loads; false where there is no equilibrium under all of them.
bool StretchedPlate::begin_with_constant(Path& path, const LargeDeflectionOptions& options,
                                         LargeDeflections& result) const {
  const auto& constant = *path.loads->constant;
  Path first{.loads = &constant, .now = undeformed(constant), .rate = {}};
  grow(first, options, result);
  path.work = first.work, path.bytes = first.bytes;
  if (first.factor < 1) {
    result.stop_reason = fmt::format("no equilibrium found beyond {:.4g} of the constant loads", first.factor);
    path.now = std::move(first.now);
    return false;
  }
  LoadStep start = result.steps.back();
  start.factor = 0, start.snapped = result.snapped();
  result.steps = {start};
  path.now = at(*path.loads, first.now.bending, 0, first.now.on_faces);
  return true;
}

/// Follows the path of equilibria by its length until the load factor is 1.
void StretchedPlate::follow(Path& path, const LargeDeflectionOptions& options, LargeDeflections& result) const {
  constexpr double first = 0.05;  // length
  Arc arc = look_along(path, {zero_like(path.now.bending)});
  arc.step = first;
  if (!result.steps.empty()) {
    LoadStep start = result.steps.back();
    result.steps.clear();
    add_step(path, start, result);
  }
  for (std::size_t n = 0; path.factor < 1; ++n) {
    if (n == options.max_steps) {
      result.stop_reason =
          fmt::format("the path is at a load factor of {:.4g} after {} steps: raise `max_steps`", path.factor, n);
      return;
    }
    if (!advance_along(path, arc, options, result)) return;
  }
}

/// Finds the next equilibrium along the path; false where there is none within the least step.
bool StretchedPlate::advance_along(Path& path, Arc& arc, const LargeDeflectionOptions& options,
                                   LargeDeflections& result) const {
  constexpr double least = 1e-5, most = 1, usual = 5, turned = 0.9;  // lengths; iterations; cosine
  for (;; arc.step /= 2) {
    if (arc.step < least) return false;
    LoadStep step;
    Path next = path;
    next.factor += arc.step * arc.factor;
    next.now = at(*path.loads, path.now.bending + arc.step * arc.bending, next.factor, {});
    bool found = correct(next, arc, options, step);
    if (found && next.factor > 1) {
      const double share = (1 - path.factor) / (next.factor - path.factor);
      next.factor = 1, next.now = at(*path.loads, (1 - share) * path.now.bending + share * next.now.bending, 1, {});
      found = correct(next, {zero_like(arc.bending)}, options, step);
    }
    result.iterations += step.iterations;
    if (!found) continue;
    Arc after = look_along(next, arc);
    const Arc chord{next.now.bending - path.now.bending, next.factor - path.factor};
    const double length = std::sqrt(along(chord, chord.bending, chord.factor));
    if (along(arc, after.bending, after.factor) < turned) continue;
    next.length += length;
    next.work += work_along(path, next, arc, after);
    if (const auto limit = limit_between(path, next, arc, after)) result.limits.push_back(*limit);
    after.step = std::min(most, arc.step * std::clamp(usual / double(step.iterations + 1), 0.5, 2.0));
    path = std::move(next), arc = std::move(after);
    add_step(path, step, result);
    return true;
  }
}

LargeDeflections StretchedPlate::equilibrium(const PlateLoads& loads, const LargeDeflectionOptions& options) const {
  LargeDeflections result;
  Path path{.loads = &loads, .now = undeformed(loads), .rate = {}};
  if (!loads.constant || begin_with_constant(path, options, result)) {
    if (options.control == LoadControl::arc_length)
      follow(path, options, result);
    else
      grow(path, options, result);
    result.converged = path.factor >= 1;
    if (result.converged)
      result.stop_reason = fmt::format("residual below tolerance in {} load steps", result.steps.size());
    if (result.stop_reason.empty())
      result.stop_reason = fmt::format("no equilibrium found beyond {:.4g} of the loads", path.factor);
  }
  if (!result.limits.empty())
    result.stop_reason += fmt::format(", limit points at load factors {:.5g}", fmt::join(result.limits, ", "));
  auto& now = path.now;
  result.external_work = path.work;
  result.bending_energy = now.bending_energy, result.membrane_energy = now.membrane_energy;
  if (plate_.problem().coupled()) {  // linear in the rotations, on which nothing else of the plane acts
    State turned = now.bending;
    turned.row(0).setZero();
    result.coupling_energy = -work(plate_, now.on_bending, turned);
    result.membrane_energy -= result.coupling_energy;
  }
  result.stored_by_deflections = stored_by_deflections(plate_, loads, 1, now.bending);
  result.factor_bytes = path.bytes;
  if (contact_) {
    const Eigen::VectorXd openings = contact_->rows().openings(now.bending, now.membrane);
    result.touching.faces = contact_->rows().contacts((now.on_faces.array() > 0).select(0, openings), now.on_faces);
  }
  result.largest_rotation = largest_of_points(plate_, now.bending.bottomRows(2).colwise().norm());
  result.stretch = plane_.stretching().stretch(now.bending);
  result.membrane_forces = plane_.stretching().membrane_forces(now.bending, now.membrane);
  result.bending = std::move(now.bending), result.membrane = std::move(now.membrane);
  result.on_bending = std::move(now.on_bending);
  return result;
}

}  // namespace plate
