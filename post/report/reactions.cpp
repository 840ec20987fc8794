#include "post/report/reactions.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <map>
#include <numbers>

#include "plate/formulation/boundary.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/inertia.hpp"
#include "plate/formulation/operator.hpp"
#include "plate/model/loads.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/model/reduction.hpp"
#include "plate/model/space.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "plate/solve/prescribed_displacements.hpp"
#include "post/files/recorder.hpp"
#include "post/report/response.hpp"

namespace post {
namespace {

using geometry::Point;

Wrench operator*(double factor, const Wrench& w) {
  return {factor * w.force, factor * w.moment_x, factor * w.moment_y};
}

/// The size of a wrench about `centre`, as a force at the distance `arm`.
double size(const Wrench& w, const Point& centre, double arm) {
  return std::max(std::abs(w.force),
                  std::hypot(w.moment_x - centre.y() * w.force, w.moment_y + centre.x() * w.force) / arm);
}

/// Sides that hold a fictitious point. Beside a mirror plane the other edge goes on: what stands beyond both is of that
/// edge.
std::vector<int> sides_that_hold(const plate::Boundary& boundary, const plate::FictitiousPoint& point) {
  const auto mirror = [&](int side) { return boundary.sides[std::size_t(side)].kind == plate::SupportKind::symmetry; };
  const auto [one, other] = point.sides;
  if (other < 0) return {one};
  if (mirror(one) != mirror(other)) return {mirror(one) ? other : one};
  return {one, other};
}

/// True where a side holds this rotation, or as one of a plane this displacement: not its own where it is along an
/// axis.
bool bears(const plate::Side& side, const plate::Dof& dof) {
  using enum plate::SupportKind;
  const int axis = side.normal_axis();
  const bool across = dof.component == (axis == 0 ? 2 : 1);  // psi = (-theta_y, theta_x)
  if (plate::is_deflection(dof) || axis < 0 || (side.kind != symmetry && side.kind != simply_supported_hard))
    return true;
  return across == (side.kind == symmetry);
}

/// True where a holder bears a rotation of a point of the plate: by a side at the point, or as no edge.
bool bears(const plate::Boundary& boundary, std::uint32_t holder, const plate::Dof& dof) {
  constexpr double near = 1e-6;  // spacings
  if (const auto kind = boundary.holders[holder].kind;
      kind == plate::SupportKind::u_alone || kind == plate::SupportKind::v_alone)
    return dof.component == (kind == plate::SupportKind::u_alone ? 2 : 1);
  bool beside = false;
  for (const auto& side : boundary.sides) {
    if (side.name != boundary.holders[holder].name || std::abs(side.inside(boundary.lattice[dof.point])) > near)
      continue;
    if (bears(side, dof)) return true;
    beside = true;
  }
  return !beside;
}

/// The holders of every degree of freedom that is held.
std::map<plate::Dof, std::vector<std::uint32_t>> holders_by_dof(const plate::Boundary& boundary) {
  std::map<plate::Dof, std::vector<std::uint32_t>> result, beside;  // those that bear it, and others there
  const auto add = [&](const plate::Dof& dof, std::uint32_t holder, bool bears_it) {
    if (!boundary.constraints.held(dof)) return;
    auto& all = (bears_it ? result : beside)[dof];
    if (std::ranges::find(all, holder) == all.end()) all.push_back(holder);
  };
  for (const auto& hold : boundary.holds)
    for (const auto dof : plate::dofs_of(hold.point))
      if (plate::is_deflection(dof) != hold.rotations) add(dof, hold.holder, bears(boundary, hold.holder, dof));
  for (std::size_t i = 0; i < boundary.fictitious.size(); ++i)
    for (const int s : sides_that_hold(boundary, boundary.fictitious[i])) {
      const auto& side = boundary.sides[std::size_t(s)];
      const auto by = plate::holder(boundary.holders, side);
      if (by == boundary.holders.size()) continue;  // beyond an edge that is held in the plane alone, or across it
      for (const auto dof : plate::dofs_of(std::uint32_t(boundary.cloud.plate_points + i)))
        add(dof, by, bears(side, dof));
    }
  result.merge(beside);  // where none bears it
  return result;
}

/// Row of an elastic support: that of the hub whose spring it is, `next` where it is of none.
std::size_t row_of_support(const plate::ElasticSupport& part, const plate::Boundary& boundary, std::size_t next) {
  const auto found = std::ranges::find_if(boundary.holders, [&](const plate::Holder& holder) {
    return holder.kind == plate::SupportKind::hub && holder.name == part.name;
  });
  return found == boundary.holders.end() ? next : std::size_t(found - boundary.holders.begin());
}

}  // namespace

Wrench wrench(const Point& at, std::size_t component, double value) {
  if (component == 1) return {0, value, 0};
  if (component == 2) return {0, 0, value};
  return {value, value * at.y(), -value * at.x()};
}

void Applied::add(double factor, const Applied& other) {
  sum += factor * other.sum;
  size += std::abs(factor) * other.size;
  held += factor * other.held;
}

Supports::Supports(const plate::Boundary& boundary) : boundary_(&boundary) {
  const auto& positions = boundary.cloud.positions;
  const auto& held = boundary.constraints.held();
  const auto holders = holders_by_dof(boundary);
  const auto& ties = boundary.constraints.ties();  // ascending by follower, as what is held
  auto tie = ties.begin();
  for (std::uint32_t i = 0; i < held.size(); ++i) {
    const auto dof = held[i];
    Wrench unit = wrench(positions[dof.point], dof.component, 1);
    for (; tie != ties.end() && tie->follower == dof; ++tie)
      unit += wrench(positions[tie->leader.point], tie->leader.component, -tie->factor);
    const auto all = holders.find(dof);
    if (all == holders.end()) continue;  // a turn that follows another point's (plate::tie_twists): no force in sum
    for (const auto holder : all->second) shares_.push_back({holder, i, 1.0 / double(all->second.size()) * unit});
  }
  std::ranges::stable_sort(shares_, {}, &Share::holder);
  auto [low, high] = geometry::bounding_box(positions);
  for (const Eigen::Index axis : {0, 1})
    low[axis] = -plate::largest_of(boundary_->map, -low[axis]),
    high[axis] = plate::largest_of(boundary_->map, high[axis]);
  centre_ = (low + high) / 2, arm_ = (high - low).norm() / 2;
}

Applied Supports::nothing() const {
  return {{}, 0, Eigen::VectorXd::Zero(Eigen::Index(boundary_->constraints.held().size()))};
}

Applied Supports::applied(const plate::Forces& forces) const {
  Applied result{{}, 0, boundary_->constraints.on_held(forces)};
  const auto& positions = boundary_->cloud.positions;
  const auto of_point = [&](std::size_t k) -> std::array<double, 4> {
    if (!boundary_->owns(k)) return {};
    const auto force = forces.col(Eigen::Index(k));
    Wrench sum;
    for (std::size_t c = 0; c < plate::unknowns_per_point; ++c) sum += wrench(positions[k], c, force[Eigen::Index(c)]);
    return {sum.force, sum.moment_x, sum.moment_y, std::abs(force[0]) + std::hypot(force[1], force[2]) / arm_};
  };
  const auto [force, moment_x, moment_y, size] = plate::ordered_sum<4>(boundary_->map, positions.size(), of_point);
  result.sum = {force, moment_x, moment_y}, result.size = size;
  return result;
}

Eigen::VectorXd Supports::reaction(const Eigen::VectorXd& internal, const Applied& loads,
                                   const Applied* inertia) const {
  Eigen::VectorXd result = -internal - loads.held;
  if (inertia) result += inertia->held;
  return result;
}

Balance Supports::balance(const Eigen::VectorXd& internal, const Applied& loads, const Applied* inertia,
                          const plate::State& state) const {
  Balance result{std::vector<Wrench>(boundary_->holders.size()), loads.sum, {}, 0};
  const Eigen::VectorXd reaction = this->reaction(internal, loads, inertia);
  const auto& held = boundary_->constraints.held();
  for (std::uint32_t h = 0; h < result.supports.size(); ++h) {
    const auto of_holder = std::ranges::equal_range(shares_, h, {}, &Share::holder);
    const auto [force, moment_x, moment_y] =
        plate::ordered_sum<3>(boundary_->map, of_holder.size(), [&](std::size_t s) {
          const auto& [holder, i, unit] = of_holder[std::ptrdiff_t(s)];
          const double size = boundary_->owns(held[i].point) ? reaction[i] : 0;
          return std::array<double, 3>{size * unit.force, size * unit.moment_x, size * unit.moment_y};
        });
    result.supports[h] = {force, moment_x, moment_y};
  }
  for (const auto& part : boundary_->elastic_supports.holding()) {
    const auto row = row_of_support(*part, *boundary_, result.supports.size());
    result.supports.resize(std::max(result.supports.size(), row + 1));
    result.supports[row] += applied(part->force(state)).sum;
  }
  Wrench left = result.sum();
  left += loads.sum;
  double largest = loads.size;
  for (const auto& one : result.supports) largest = std::max(largest, size(one, centre_, arm_));
  if (inertia) {
    result.inertia = inertia->sum;
    left += -1 * inertia->sum;
    largest = std::max(largest, size(inertia->sum, centre_, arm_));
  }
  result.residual = largest > 0 ? size(left, centre_, arm_) / largest : 0;
  return result;
}

Eigen::MatrixXd Supports::elastic_forces(const plate::Operator& plate) const {
  constexpr std::size_t most = 16;
  const auto& held = boundary_->constraints.held();
  const auto elastic_supports = boundary_->elastic_supports.holding();
  const auto points = Eigen::Index(plate.points());
  const auto holders = boundary_->holders.size();
  std::vector<std::size_t> rows;  // of the elastic supports
  std::size_t all = holders;
  for (const auto& part : elastic_supports)
    rows.push_back(row_of_support(*part, *boundary_, all)), all += rows.back() == all;
  const bool each = all <= most;
  std::vector<plate::State> units(each ? holders : 1, plate::zero_state(points));
  for (const auto& [holder, i, unit] : shares_) plate::at_dof(units[each ? holder : 0], held[i]) += unit.force;
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(Eigen::Index(each ? all : 1), plate::unknowns_per_point * points);
  plate::Forces forces;
  const auto add = [&](std::size_t row) {
    result.row(Eigen::Index(row)) += forces.reshaped<Eigen::RowMajor>().transpose();
  };
  for (std::size_t s = 0; s < units.size(); ++s) {  // the stiffness is symmetric
    plate.internal_force(units[s], forces);
    add(s);
  }
  plate::State along_w = plate::zero_state(points);
  along_w.row(0).setOnes();
  for (std::size_t i = 0; i < elastic_supports.size(); ++i) {  // what they do to the plate is the support's own force
    forces = -elastic_supports[i]->force(along_w);
    add(each ? rows[i] : 0);
  }
  return result;
}

namespace {

Eigen::VectorXd on_held(const plate::Formulation& plate, const plate::Operator& forces, const plate::State& state) {
  plate::Forces internal;
  forces.internal_force(state, internal);
  return plate.constraints().on_held(internal);
}

std::vector<ReactionSummary::Support> supports_of(const plate::Formulation& plate) {
  std::vector<ReactionSummary::Support> result;
  for (const auto& holder : plate.boundary().holders) result.push_back({holder.name, holder.position});
  for (const auto& part : plate.boundary().elastic_supports.holding())
    if (row_of_support(*part, plate.boundary(), result.size()) == result.size())
      result.push_back({part->name, part->position});
  return result;
}

/// Mass times acceleration of every degree of freedom, held or not.
std::function<plate::Forces(const plate::State&)> inertial_force(const plate::Formulation& plate, double rotary,
                                                                 bool of_cells) {
  if (of_cells)
    return [inertia = std::make_shared<plate::Inertia>(plate.inertia(rotary))](const plate::State& acceleration) {
      return inertia->whole(acceleration);
    };
  return [mass = plate::unconstrained_mass(plate, rotary)](const plate::State& acceleration) -> plate::Forces {
    return mass.cwiseProduct(acceleration);
  };
}

plate::Forces pressing(const plate::ImpactorMotion& contact_force, Eigen::Index points) {
  plate::Forces result = plate::zero_forces(points);
  for (const auto& [dof, factor] : contact_force.terms) plate::at_dof(result, dof) += factor * contact_force.force;
  return result;
}

}  // namespace

struct ReactionRows::Moving {
  Supports supports;
  std::vector<Applied> loads;
  std::function<plate::Forces(const plate::State&)> inertial_force;

  Moving(const plate::Formulation& plate, double rotary, bool mass_of_cells)
      : supports(plate.boundary()), inertial_force(post::inertial_force(plate, rotary, mass_of_cells)) {
    for (const auto& load : plate.loads()) loads.push_back(supports.applied(load.forces));
  }
};

ReactionRows::ReactionRows(const plate::Formulation& plate, double rotary, bool mass_of_cells, double drag)
    : supports_(supports_of(plate)), plate_(&plate), rotary_(rotary), drag_(drag), mass_of_cells_(mass_of_cells) {}

void ReactionRows::add(const plate::Instant& now, const plate::Operator& forces) {
  if (supports_.empty()) return;
  if (!now.acceleration) {
    return add_at_rest(now.time, *plate_, forces, now.what_strains(), [&](const Supports& supports) {
      auto loads = supports.applied(plate::acting_load(*plate_));
      if (now.stretched) loads.add(1, supports.applied(*now.stretched));  // apart: they may cancel
      return loads;
    });
  }
  if (!moving_) moving_ = std::make_shared<const Moving>(*plate_, rotary_, mass_of_cells_);
  const auto& [supports, each, inertial_force] = *moving_;
  auto loads = supports.nothing();
  for (std::size_t i = 0; i < each.size(); ++i) {
    const auto& one = plate_->loads()[i];
    const double factor = plate::factor(one.history, now.time);
    loads.add(factor, one.moving ? supports.applied(one.moving->whole(now.time, plate_->points())) : each[i]);
  }
  if (now.stretched) loads.add(1, supports.applied(*now.stretched));
  if (now.contact_force) loads.add(1, supports.applied(pressing(*now.contact_force, now.state.cols())));
  plate::State acceleration = now.acceleration();
  if (drag_ > 0) acceleration += drag_ * now.velocity();
  const auto inertia = supports.applied(inertial_force(acceleration));
  const plate::State strained = now.strained ? now.strained() : plate::State();
  const plate::State& state = now.strained ? strained : now.state;
  const auto internal = now.held_force ? *now.held_force : on_held(*plate_, forces, state);
  balances_.emplace_back(now.time, supports.balance(internal, loads, &inertia, state));
}

void ReactionRows::add(double time, const plate::Formulation& plate, const plate::Operator& forces,
                       const plate::State& state, double share) {
  add(time, plate, forces, state, plate::Forces(share * plate::acting_load(plate)));
}

void ReactionRows::add(double time, const plate::Formulation& plate, const plate::Operator& forces,
                       const plate::State& state, const plate::Forces& load) {
  supports_ = supports_of(plate);
  if (supports_.empty()) return;
  add_at_rest(time, plate, forces, state, [&](const Supports& supports) { return supports.applied(load); });
}

void ReactionRows::add_at_rest(double time, const plate::Formulation& plate, const plate::Operator& forces,
                               const plate::State& state, const std::function<Applied(const Supports&)>& loads) {
  const Supports supports(plate.boundary());
  const auto internal = on_held(plate, forces, state);
  const auto load = loads(supports);
  balances_.emplace_back(time, supports.balance(internal, load, nullptr, state));
  if (pieces_ == 0) return;
  constexpr double decay = 5;  // layers, within which twist and shear by an edge are below 1 %
  const auto reaction = supports.reaction(internal, load, nullptr);
  take_edges(time, supports.along_edges(reaction, pieces_, decay * plate.section().layer()));
}

/// Adds rows of edge_reactions.csv and corner_forces.csv.
void ReactionRows::take_edges(double time, const EdgeReactions& found) {
  edges_.columns = {"time",
                    "support",
                    "s",
                    "x",
                    "y",
                    "piece_length",
                    "force_per_length",
                    "moment_per_length",
                    "twist_per_length",
                    "kirchhoff_force"};
  corners_.columns = {"time", "corner", "x", "y", "force"};
  for (const auto& [edge, values] : found.curves)
    for (const auto& one : values)
      edges_.rows.push_back({time, edge, one.s, one.position.x(), one.position.y(), one.length, one.force, one.moment,
                             one.twist, one.kirchhoff_force});
  for (const auto& one : found.corners)
    corners_.rows.push_back({time, one.corner, one.position.x(), one.position.y(), one.force});
  along_edges_ = found;
}

namespace {

/// The largest forces, moments and twists along each edge.
std::vector<EdgePeak> largest_along(const std::vector<EdgeCurve>& curves) {
  constexpr std::array<std::pair<const char*, double EdgeValue::*>, 3> quantities{
      {{"kirchhoff_force", &EdgeValue::kirchhoff_force},
       {"moment_per_length", &EdgeValue::moment},
       {"twist_per_length", &EdgeValue::twist}}};
  std::map<std::string, std::vector<EdgeValue>> edges;  // all sides of a name
  for (const auto& [edge, values] : curves) edges[edge].insert(edges[edge].end(), values.begin(), values.end());
  std::vector<EdgePeak> result;
  for (const auto& [edge, values] : edges)
    for (const auto& [quantity, of] : quantities) {
      const auto& most = *std::ranges::max_element(values, {}, [&](const EdgeValue& one) { return std::abs(one.*of); });
      result.push_back({edge, quantity, most.*of, most.s, most.position});
    }
  return result;
}

}  // namespace

Table ReactionRows::table() const {
  Table table{{"time", "support", "x", "y", "force", "moment_x", "moment_y", "residual"}, {}};
  for (const auto& one : balances_) {
    const auto& balance = one.second;
    const auto row = [&, t = one.first](const std::string& name, const std::optional<geometry::Point>& x,
                                        const Wrench& w) {
      table.rows.push_back({t, name, x ? Cell(x->x()) : Cell(), x ? Cell(x->y()) : Cell(), w.force, w.moment_x,
                            w.moment_y, balance.residual});
    };
    for (std::size_t i = 0; i < supports_.size(); ++i)
      row(supports_[i].name, supports_[i].position, supports_[i].written(balance.supports[i]));
    row("loads", std::nullopt, balance.loads);
    if (balance.inertia) row("inertia", std::nullopt, *balance.inertia);
  }
  return table;
}

void record(const ReactionRows& rows, Recorder& recorder) {
  if (!rows.empty()) recorder.table("reactions", rows.table());
  if (!rows.edges().rows.empty()) recorder.table("edge_reactions", rows.edges());
  if (!rows.corners().rows.empty()) recorder.table("corner_forces", rows.corners());
}

std::optional<ReactionSummary> ReactionRows::summary() const {
  if (balances_.empty()) return std::nullopt;
  ReactionSummary result{supports_, balances_.back().first, balances_.back().second, 0, {}};
  for (std::size_t i = 0; i < supports_.size(); ++i) {
    const auto size = [&](const auto& row) { return std::abs(row.second.supports[i].force); };
    const auto& most = *std::ranges::max_element(balances_, {}, size);
    result.largest.push_back({most.first, most.second.supports[i].force});
  }
  for (const auto& [time, balance] : balances_)
    result.largest_residual = std::max(result.largest_residual, balance.residual);
  result.truncation = truncation_;
  result.edges = largest_along(along_edges_.curves), result.corners = along_edges_.corners;
  return result;
}

struct HarmonicReactions::Moving {
  Supports supports;
  Applied loads;
  plate::Inertia inertia;
};

HarmonicReactions::HarmonicReactions(const plate::Formulation& plate, const plate::Damping& damping)
    : HarmonicReactions(plate, damping, plate, plate.inertia(1)) {}

HarmonicReactions::HarmonicReactions(const plate::Formulation& plate, const plate::Damping& damping,
                                     const plate::Operator& stiffness, plate::Inertia inertia)
    : plate_(plate), stiffness_(stiffness), damping_(damping), supports_(supports_of(plate)) {
  if (supports_.empty()) return;
  const Supports supports(plate.boundary());
  auto loads = supports.nothing();
  for (const auto& load : plate.loads()) loads.add(1, supports.applied(load.forces));
  functionals_ = supports.elastic_forces(stiffness);
  moving_ = std::make_unique<const Moving>(Moving{supports, std::move(loads), std::move(inertia)});
}

HarmonicReactions::~HarmonicReactions() = default;

/// The motion is u = A cos - B sin: its velocity and acceleration are i omega and -omega^2 times (A + i B).
std::vector<Response> HarmonicReactions::at(double frequency, const plate::State& in_phase,
                                            const plate::State& quadrature) const {
  if (!moving_) return {};
  const auto& [supports, loads, inertia] = *moving_;
  const double omega = 2 * std::numbers::pi * frequency;
  const auto balance = [&](const plate::State& state, const plate::State& velocity, const Applied& load) {
    const plate::State strained = state + damping_.stiffness * velocity;
    const auto inertial = supports.applied(inertia.whole(damping_.mass * velocity - omega * omega * state));
    return supports.balance(on_held(plate_, stiffness_, strained), load, &inertial, strained);
  };
  const auto real = balance(in_phase, -omega * quadrature, loads);
  const auto imaginary = balance(quadrature, omega * in_phase, supports.nothing());
  double largest = 0;
  for (std::size_t s = 0; s < supports_.size(); ++s)
    largest = std::max(largest, std::hypot(real.supports[s].force, imaginary.supports[s].force));
  std::vector<Response> result;
  for (std::size_t s = 0; s < supports_.size(); ++s) {
    const auto a = supports_[s].written(real.supports[s]), b = supports_[s].written(imaginary.supports[s]);
    const std::complex force(a.force, b.force);
    const double error = change_ * largest;
    result.push_back({frequency, "support " + supports_[s].name, "force", force, {}, error < std::abs(force)});
    result.push_back({frequency, "support " + supports_[s].name, "moment_x", {a.moment_x, b.moment_x}, {}, true});
    result.push_back({frequency, "support " + supports_[s].name, "moment_y", {a.moment_y, b.moment_y}, {}, true});
  }
  return result;
}

}  // namespace post
