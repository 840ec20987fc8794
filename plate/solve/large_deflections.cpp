#include "plate/solve/large_deflections.hpp"

#include <fmt/format.h>
#include <Eigen/Eigenvalues>
#include <algorithm>
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

/// Degrees of freedom that hold a piece in its plane as its supports do not.
std::vector<Dof> pins_of(const std::vector<std::uint32_t>& points, const Formulation& membrane) {
  constexpr double none = 1e-6;
  const auto& positions = membrane.cloud().positions;
  const auto& constraints = membrane.constraints();
  geometry::Point centre(0, 0);
  for (const auto k : points) centre += positions[k] / double(points.size());
  double length = 0;
  for (const auto k : points) length = std::max(length, (positions[k] - centre).norm());
  const MotionsInPlane rigid(centre, length > 0 ? length : 1);
  std::vector<char> here(positions.size(), 0);
  for (const auto k : points) here[k] = 1;
  Eigen::Matrix3d held = Eigen::Matrix3d::Zero();
  for (const auto& fixed : constraints.fixed())
    if (here[fixed.point]) {
      const auto row = rigid.row(fixed, positions[fixed.point]);
      held += row * row.transpose();
    }
  const auto& ties = constraints.ties();
  for (std::size_t i = 0; i < ties.size();) {
    const auto follower = ties[i].follower;
    Eigen::Vector3d row = rigid.row(follower, positions[follower.point]);
    for (; i < ties.size() && ties[i].follower == follower; ++i)
      row -= ties[i].factor * rigid.row(ties[i].leader, positions[ties[i].leader.point]);
    if (here[follower.point]) held += row * row.transpose();
  }
  std::vector<Dof> result;
  for (;;) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> motions(held);
    if (result.size() == 3 || motions.eigenvalues()[0] > none) return result;
    const Eigen::Vector3d motion = motions.eigenvectors().col(0);
    Dof best{};
    double most = 0;
    for (const auto k : points)
      for (const int component : {1, 2}) {
        const auto one = dof(k, component);
        const double moved = std::abs(rigid.row(one, positions[k]).dot(motion));
        if (moved > most * (1 + 1e-9) && !constraints.held(one)) best = one, most = moved;
      }
    if (most == 0) return result;
    const auto row = rigid.row(best, positions[best.point]);
    held += row * row.transpose(), result.push_back(best);
  }
}

/// Pins of all pieces.
std::vector<Dof> pins_of(const Formulation& membrane) {
  if (membrane.held()) return {};
  DisjointSets sets(membrane.points());
  for (std::uint32_t k = 0; k < membrane.points(); ++k)
    for (const auto& bond : membrane.families()[k]) sets.join(k, bond.neighbour);
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

/// The sum of a matrix and one of its first points.
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

}  // namespace

Constraints pinned(const Formulation& membrane) {
  if (membrane.distributed()) return membrane.constraints_about();
  Constraints result;
  result.add(membrane.constraints(), 0);
  for (const auto& pin : pins_of(membrane)) result.fix(pin);
  result.resolve();
  return result;
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
  return heat.none() ? PointMatrix() : membrane.stretching()->stiffness_of_heat(heat.curvature);
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
  double bending_energy = 0, membrane_energy = 0, potential = 0, residual = 0;

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
    return;
  }
  // the unknowns of a point and of the same point in its plane stand together
  std::vector<int> both;
  for (const int k : plane_.order()) both.push_back(k), both.push_back(int(points) + k);
  unknowns_ = unknowns(stacked(diagonal_, plane_.diagonal()), both);
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
  Now now{bending, plane_.displacements(bending, factor * loads.in_plane), {}, {}};
  if (contact_) now.on_faces = contact_->part(now.bending, now.membrane, on_faces);
  Forces on_membrane;
  plane_.stretching().internal_force(now.bending, now.membrane, now.on_bending, on_membrane);
  if (loads.heat.points() > 0) now.on_bending -= factor * product(loads.heat, now.bending);
  plate_.internal_force(now.bending, now.left);
  now.left += now.on_bending + factor * loads.across;
  if (contact_) contact_->rows().press(now.on_faces, now.left, on_membrane);
  plate_.constraints().fold(now.left);
  now.bending_energy = plate_.strain_energy(now.bending);
  now.membrane_energy = plate_.sum_of_points(plane_.stretching().energies(now.bending, now.membrane));
  now.potential = -factor * displacement_of(plate_, loads, now.bending, now.membrane);
  now.residual = norm(now.left);
  if (!std::isfinite(now.energy()) || !std::isfinite(now.residual))
    throw NumericalError(fmt::format("large deflections: not finite at a load factor of {:.3g}", factor));
  return now;
}

/// The stiffness there, with the least share of its diagonal that makes it positive.
std::unique_ptr<Factor> StretchedPlate::tangent(const Now& now, const PlateLoads& loads, double factor,
                                                double& shift) const {
  constexpr double first = 1e-4, growth = 10, most = 1e4;
  State both = stacked(now.bending, now.membrane);
  if (plate_.distributed()) of_both_.impose(both);  // of all that the stiffness looks at
  auto matrix = with_first(bending_, plane_.stretching().stiffness(of_plate(both), of_plane(both)));
  if (loads.heat.points() > 0) add(loads.heat, factor, matrix);
  matrix = folded(std::move(matrix), of_both_);
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

/// Newton's iteration at the load factor of a step, each way as far as it lowers the energy.
bool StretchedPlate::iterate(Now& now, const PlateLoads& loads, const LargeDeflectionOptions& options,
                             LoadStep& step) const {
  constexpr std::size_t most = 30;
  constexpr int halvings = 10;
  constexpr double rounding = 1e-13;
  Forces load = step.factor * loads.across;
  plate_.constraints().fold(load);
  for (step.iterations = 0;; ++step.iterations) {
    stop_if_asked("large deflections", plate_.constraints());
    Forces stretched = now.on_bending;
    plate_.constraints().fold(stretched);
    const double scale = std::max(norm(load), norm(stretched));
    step.residual = scale > 0 ? now.residual / scale : 0;
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
};

/// Finds how the plate goes on from where it is.
void StretchedPlate::look_ahead(Path& path) const {
  double shift = 0;
  const auto& [across, in_plane, heat] = *path.loads;
  const auto inverse = tangent(path.now, *path.loads, path.factor, shift);
  PlateLoads by_factor{across, in_plane};
  if (heat.points() > 0) by_factor.across -= product(heat, path.now.bending);
  path.rate = rate(*inverse, path.now, by_factor);
  path.along = displacement_of(plate_, by_factor, path.rate.bending, path.rate.membrane);
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
    step.strain_energy = next.bending_energy + next.membrane_energy;
    const Path before = path;
    path.now = std::move(next), path.factor = step.factor;
    look_ahead(path);
    step.stable = path.stable;
    path.work += work_between(before, path);
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

LargeDeflections StretchedPlate::equilibrium(const PlateLoads& loads, const LargeDeflectionOptions& options) const {
  constexpr double far = 2;  // thicknesses, of the first step by linear theory
  LargeDeflections result;
  Path path{.loads = &loads, .now = undeformed(loads), .rate = {}};
  look_ahead(path);
  const double linear = largest_deflection(plate_, path.rate.bending);
  if (linear > 0) path.step = std::min(1.0, far * plate_.section().thickness / linear);
  while (path.factor < 1 && advance(path, options, result)) {
  }
  result.converged = path.factor >= 1;
  result.stop_reason = result.converged ? fmt::format("residual below tolerance in {} load steps", result.steps.size())
                                        : fmt::format("no equilibrium found beyond {:.4g} of the loads", path.factor);
  auto& now = path.now;
  result.external_work = path.work;
  result.bending_energy = now.bending_energy, result.membrane_energy = now.membrane_energy;
  if (loads.heat.points() > 0)
    result.stored_by_deflections = work(plate_, product(loads.heat, now.bending), now.bending) / 2;
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
