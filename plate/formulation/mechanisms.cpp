#include "plate/formulation/mechanisms.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <set>

#include "plate/formulation/pieces.hpp"
#include "plate/model/dense_algebra.hpp"
#include "plate/model/reduction.hpp"
#include "plate/model/space.hpp"

namespace plate {
namespace {

using geometry::Point;

/// Coordinates in lattice units are multiples of 2^-20: no sound triangle has less area.
constexpr double straight = 1e-9;

double cross(const Point& a, const Point& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace

RigidParts::RigidParts(const Boundary& boundary, const geometry::Families& families, PlateLaw law)
    : boundary_(boundary),
      families_(families),
      law_(law),
      sets_(families.points()),
      line_(families.points(), Point(0, 0)) {
  for (std::uint32_t k = 0; k < families.points(); ++k) {
    const auto& constraints = boundary.constraints;
    follows_.push_back(!boundary.is_plate(k) && constraints.held(dof(k, 0)) && constraints.held(dof(k, 1)) &&
                       constraints.held(dof(k, 2)));
    line_[k] = line_of(k);
  }
  // what has an image is tied to all that the image is bonded to
  for (const auto& tie : boundary.constraints.ties())
    if (follows_[tie.follower.point]) line_[tie.leader.point] = Point(0, 0);
  for_each_bond([&](std::uint32_t k, std::uint32_t j) {
    if (follows_[k] || follows_[j] || sets_.root(k) == sets_.root(j)) return;
    if (on_line(k) && on_line(j)) sets_.join(k, j);  // one chain; its points' turns are counted one by one
    if (!on_line(k) && !on_line(j)) join_triangle(k, j);
  });
  boundary.elastic_supports.for_each_joined([&](std::uint32_t k, std::uint32_t j) { sets_.join(k, j); });
  number();
}

std::size_t RigidParts::count_of_all() {
  const auto numbers = set_numbers(sets_, boundary_);
  std::set<std::int64_t> own;
  for (std::uint32_t k = 0; k < boundary_.cloud.plate_points; ++k)
    if (boundary_.owns(k) && has(k)) own.insert(numbers[k]);
  const auto found = gathered(boundary_.map, std::vector<std::int64_t>(own.begin(), own.end()));
  return std::set<std::int64_t>(found.begin(), found.end()).size();
}

void RigidParts::number() {
  part_.assign(families_.points(), none);
  for (std::uint32_t k = 0; k < families_.points(); ++k) {
    if (follows_[k] || (!boundary_.is_plate(k) && families_[k].empty())) continue;
    const auto root = sets_.root(k);
    if (root == k) {
      part_[k] = std::uint32_t(first_.size());
      first_.push_back(k), points_.push_back(0), extent_.push_back(1);
    }
    const auto own = part_[k] = part_[root];
    points_[own] += boundary_.is_plate(k);
    extent_[own] = std::max(extent_[own], (boundary_.lattice[k] - boundary_.lattice[root]).norm());
  }
}

Point RigidParts::line_of(std::uint32_t k) const {
  const auto family = families_[k];
  if (family.empty()) return {0, 0};
  const Point one = to(k, family[0].neighbour);
  for (const auto& bond : family)
    if (std::abs(cross(one, to(k, bond.neighbour))) > straight) return {0, 0};
  return one.normalized();
}

void RigidParts::join_triangle(std::uint32_t k, std::uint32_t j) {
  const auto own = families_[k], others = families_[j];
  for (std::size_t a = 0, b = 0; a < own.size() && b < others.size();) {
    const auto i = own[a].neighbour, other = others[b].neighbour;
    if (i == other && stores(k, i) && stores(j, i) && std::abs(cross(to(k, j), to(k, i))) > straight) {
      sets_.join(k, j);
      sets_.join(k, i);
      return;
    }
    a += i <= other;
    b += other <= i;
  }
}

namespace {

constexpr std::size_t most_parts = 300;  // a dense matrix of 900 x 900

using Condition = std::vector<std::pair<std::uint32_t, Eigen::Vector3d>>;  // part, factors of its unknowns: sum = 0

/// Gram matrix of all conditions on the parts' motions: supports, ties, hinges; a chain does not turn about itself.
class Conditions {
public:
  Conditions(const Boundary& boundary, const RigidParts& parts, PlateLaw law)
      : boundary_(boundary), parts_(parts), law_(law) {
    const auto size = static_cast<Eigen::Index>(RigidParts::motions * parts.count());
    gram_ = Eigen::MatrixXd::Zero(size, size);
    const auto& ties = boundary.constraints.ties();
    for (const auto dof : boundary.constraints.fixed())
      if (parts.has(dof.point)) add({{parts.part(dof.point), parts.row(dof)}});
    for (std::size_t i = 0; i < ties.size(); ++i)
      if (const auto dof = ties[i].follower; parts.has(dof.point) && (i == 0 || ties[i - 1].follower != dof)) {
        Condition condition{{parts.part(dof.point), parts.row(dof)}};
        append(condition, dof, -1);
        add(condition);
      }
    parts.for_each_bond([&](std::uint32_t k, std::uint32_t j) {
      if (!parts.has(k) || !parts.has(j) || parts.part(k) != parts.part(j)) hinge(k, j);
    });
    for (std::uint32_t k = 0; k < boundary.lattice.size(); ++k)
      if (const Point& n = parts.line(k); parts.has(k) && parts.on_line(k))
        add({{parts.part(k), n.x() * parts.row(dof(k, 1)) + n.y() * parts.row(dof(k, 2))}});
    for (const auto& part : boundary.elastic_supports.holding()) add_elastic(*part);
  }
  const Eigen::MatrixXd& gram() const { return gram_; }

private:
  void add(const Condition& condition) {
    for (const auto& [a, x] : condition)
      for (const auto& [b, y] : condition)
        gram_.block<RigidParts::motions, RigidParts::motions>(RigidParts::motions * a, RigidParts::motions * b) +=
            x * y.transpose();
  }

  /// A foundation or spring, over its largest entry.
  void add_elastic(const ElasticSupport& part) {
    const auto length = [&](const Dof& dof) { return is_deflection(dof) ? boundary_.cloud.units.spacing : 1; };
    Eigen::MatrixXd own = Eigen::MatrixXd::Zero(gram_.rows(), gram_.cols());
    part.for_each([&](const Dof& row, const Dof& column, double value) {
      own.block<RigidParts::motions, RigidParts::motions>(RigidParts::motions * parts_.part(row.point),
                                                          RigidParts::motions * parts_.part(column.point)) +=
          value * length(row) * length(column) * parts_.row(row) * parts_.row(column).transpose();
    });
    gram_ += own / own.cwiseAbs().maxCoeff();
  }

  /// factor times a degree of freedom that is held, by its leaders.
  void append(Condition& condition, const Dof& dof, double factor) const {
    const auto& ties = boundary_.constraints.ties();
    auto tie = std::ranges::lower_bound(ties, dof, {}, &Constraints::Tie::follower);
    for (; tie != ties.end() && tie->follower == dof; ++tie) {
      const bool lever = is_deflection(dof) && !is_deflection(tie->leader);  // w of rotations: [length]
      const double share = lever ? tie->factor / boundary_.cloud.units.spacing : tie->factor;
      condition.emplace_back(parts_.part(tie->leader.point), factor * share * parts_.row(tie->leader));
    }
  }
  void append_any(Condition& condition, const Dof& dof, double factor) const {
    if (parts_.has(dof.point))
      condition.emplace_back(parts_.part(dof.point), factor * parts_.row(dof));
    else
      append(condition, dof, factor);
  }

  /// Equal deflection at the bond's middle by both ends, equal slope along it; in the plane the length of the bond.
  void hinge(std::uint32_t k, std::uint32_t j) {
    const Point xi = boundary_.lattice[j] - boundary_.lattice[k];
    Condition slope, deflection;
    for (const auto& [point, sign] : {std::pair{k, 1.0}, {j, -1.0}}) {
      append_any(deflection, dof(point, 0), sign);
      for (const auto& [dof, part] : {std::pair{dof(point, 1), xi.y()}, {dof(point, 2), -xi.x()}}) {
        append_any(deflection, dof, part / 2);
        append_any(slope, dof, sign * part / xi.norm());
      }
    }
    if (law_ == PlateLaw::bending) add(deflection);
    add(slope);
  }

  const Boundary& boundary_;
  const RigidParts& parts_;
  PlateLaw law_;
  Eigen::MatrixXd gram_;
};

/// Columns: motions that meet every condition, in unknowns scaled by `scale`.
Eigen::MatrixXd free_motions(const Eigen::MatrixXd& gram, const Eigen::VectorXd& scale) {
  const Eigenpairs eigen = eigenpairs(scale.asDiagonal() * gram * scale.asDiagonal());
  constexpr double zero = 1e-11;  // rounding leaves about 1e-15, slender chains of parts 1e-6
  return eigen.vectors.leftCols((eigen.values.array() < zero).count());
}

struct Drive {
  Eigen::VectorXd sum, size;  // of the work on every unknown, and of its absolute parts
};

Drive drive(const Boundary& boundary, const RigidParts& parts, const Forces& load) {
  Drive result;
  result.sum = result.size = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(RigidParts::motions * parts.count()));
  for (std::uint32_t k = 0; k < load.cols(); ++k)
    for (const auto dof : dofs_of(k)) {
      const double force = at_dof(load, dof) * (is_deflection(dof) ? boundary.cloud.units.spacing : 1);
      if (force == 0 || !parts.has(k)) continue;
      const Eigen::Vector3d work = force * parts.row(dof);
      result.sum.segment<RigidParts::motions>(RigidParts::motions * parts.part(k)) += work;
      result.size.segment<RigidParts::motions>(RigidParts::motions * parts.part(k)) += work.cwiseAbs();
    }
  return result;
}

/// The largest part that a motion moves, and where it hangs on one that stays.
std::optional<LoosePart> largest(const Boundary& boundary, const RigidParts& parts, const Eigen::VectorXd& motion) {
  const auto moves = [&](std::uint32_t part) {
    return motion.segment<RigidParts::motions>(RigidParts::motions * part).norm() > 1e-6 * motion.norm();
  };
  std::optional<std::uint32_t> best;
  for (std::uint32_t part = 0; part < parts.count(); ++part)
    if (moves(part) && (!best || parts.points(part) > parts.points(*best))) best = part;
  if (!best) return std::nullopt;
  LoosePart result{parts.points(*best), boundary.cloud.positions[parts.first(*best)],
                   boundary.cloud.positions[parts.first(*best)]};
  parts.for_each_bond([&](std::uint32_t k, std::uint32_t j) {
    if (!parts.has(k) || !parts.has(j)) return;
    const auto a = parts.part(k), b = parts.part(j);
    if (a != b && (a == *best || b == *best)) result.ligament = boundary.cloud.positions[a == *best ? j : k];
  });
  return result;
}

/// Counts the points that turn about the line of their bonds, and finds one that the load turns.
void find_twists(const Boundary& boundary, const RigidParts& parts, const Forces& load, Mechanisms& result) {
  for (std::uint32_t k = 0; k < boundary.cloud.plate_points; ++k) {
    const auto& constraints = boundary.constraints;
    if (!boundary.owns(k) || !parts.on_line(k) || (constraints.held(dof(k, 1)) && constraints.held(dof(k, 2))))
      continue;
    ++result.twisting;
    const Point& n = parts.line(k);
    const auto force = load.col(k);
    const double scale = std::abs(force[0]) * boundary.cloud.units.spacing + std::abs(force[1]) + std::abs(force[2]);
    if (std::abs(force[1] * n.x() + force[2] * n.y()) > 1e-9 * scale)
      result.twisted = LoosePart{1, boundary.cloud.positions[k], boundary.cloud.positions[k]};
  }
}

/// The nearest point along bonds that has bonds in two directions; absent in a chain of its own.
std::optional<std::uint32_t> next_rigid(std::uint32_t from, const RigidParts& parts,
                                        const geometry::Families& families) {
  std::vector<std::uint32_t> reached{from};
  for (std::size_t i = 0; i < reached.size(); ++i)
    for (const auto& bond : families[reached[i]]) {
      const auto j = bond.neighbour;
      if (!parts.has(j) || std::ranges::find(reached, j) != reached.end()) continue;
      if (!parts.on_line(j)) return j;
      reached.push_back(j);
    }
  return std::nullopt;
}

}  // namespace

void tie_twists(Boundary& boundary, const geometry::Families& families) {
  const RigidParts parts(boundary, families);
  auto& constraints = boundary.constraints;
  std::vector<std::pair<Dof, std::vector<Constraints::Leader>>> ties;
  for (std::uint32_t k = 0; k < boundary.cloud.plate_points; ++k) {
    if (!parts.on_line(k)) continue;
    const Point& n = parts.line(k);
    const std::uint32_t main = std::abs(n.x()) >= std::abs(n.y()) ? 1 : 2, other = 3 - main;
    const auto rigid = next_rigid(k, parts, families);
    if (!rigid || constraints.held(dof(k, main))) continue;
    auto& leaders = ties.emplace_back(dof(k, main), std::vector<Constraints::Leader>{{dof(*rigid, main), 1}}).second;
    const double share = main == 1 ? n.y() / n.x() : n.x() / n.y();
    if (share != 0) leaders.push_back({dof(*rigid, other), share}), leaders.push_back({dof(k, other), -share});
  }
  if (!ties.empty()) constraints.tie_more(std::move(ties));
}

Mechanisms mechanisms(const Boundary& boundary, const geometry::Families& families, const std::vector<Piece>& pieces,
                      const Forces& load, PlateLaw law) {
  RigidParts parts(boundary, families, law);
  Mechanisms result;
  result.parts = parts.count();
  find_twists(boundary, parts, load, result);
  if (boundary.map.distributed()) {
    result.twisting = std::size_t(count_of_all(boundary.map, std::int64_t(result.twisting)));
    result.parts = parts.count_of_all(), result.twisted.reset();
    result.searched = result.parts == pieces.size() && result.twisting == 0;
    return result;
  }
  int chains = 0;  // pieces of their own, whose turn as a whole is one of their free motions
  for (const auto& piece : pieces)
    chains += piece.free_modes > 0 && parts.on_line(piece.first_point) &&
              parts.points(parts.part(piece.first_point)) == piece.points;
  result.twisting -= std::size_t(chains);
  if (parts.count() == pieces.size()) return result;  // every piece is rigid in itself
  result.searched = parts.count() <= most_parts;
  if (!result.searched) return result;

  const Eigen::MatrixXd gram = Conditions(boundary, parts, law).gram();
  const Eigen::VectorXd scale = gram.diagonal().unaryExpr([](double d) { return d > 0 ? 1 / std::sqrt(d) : 1; });
  const Eigen::MatrixXd motions = free_motions(gram, scale);
  result.motions = static_cast<int>(motions.cols()) + chains;
  for (const auto& piece : pieces) result.motions -= piece.free_modes;
  const auto [sum, size] = drive(boundary, parts, load);
  const Eigen::VectorXd driven = motions * (motions.transpose() * scale.cwiseProduct(sum));
  if (driven.norm() > 1e-9 * scale.cwiseProduct(size).norm()) result.driven = largest(boundary, parts, driven);
  return result;
}

namespace {

std::string free_motion(const Piece& piece) {
  return fmt::format("the piece of {} point{} about ({:g}, {:g}) can move as a rigid body in {} of 3 ways",
                     piece.points, piece.points == 1 ? "" : "s", piece.position.x(), piece.position.y(),
                     piece.free_modes);
}

std::string hanging(const LoosePart& part) {
  return fmt::format("the part of {} point{} about ({:g}, {:g}) hangs by bonds along one line through ({:g}, {:g})",
                     part.points, part.points == 1 ? "" : "s", part.position.x(), part.position.y(), part.ligament.x(),
                     part.ligament.y());
}

/// Advice that gives a ligament two rows of points.
std::string two_rows(const Formulation& plate) {
  return fmt::format("set `spacing` = {:.2g}", plate.discretization().spacing / 2);
}

}  // namespace

std::vector<Refusal> loose(const Formulation& plate) {
  std::vector<Refusal> result;
  const bool whole = plate.pieces().size() == 1, in_plane = plate.section().law == PlateLaw::membrane;
  for (const auto& piece : plate.pieces())
    if (piece.free_modes > 0)
      result.push_back(
          {whole ? Subject::support : Subject::cracks, 0,
           whole ? std::string("the plate is not held") + (in_plane ? " in its plane: " : ": ") + free_motion(piece) +
                       (in_plane ? "; hold both displacements of an edge, or of one point and \"x\" or \"y\" of another"
                                 : "; hold an edge, or pin three points not on one line")
                 : "cracks cut the plate: " + free_motion(piece) +
                       (in_plane ? " in its plane; let a support hold it there" : "")});
  if (!result.empty()) return result;
  if (plate.distributed() && !plate.mechanisms().searched)
    result.push_back(
        {Subject::cracks, 0,
         "cracks and edges leave ligaments one row of points wide, which are hinges, and several processes "
         "cannot tell what hangs by them: take a finer spacing, or one process"});
  for (const auto& part : {plate.mechanisms().driven, plate.mechanisms().twisted})
    if (part && result.empty())
      result.push_back({Subject::cracks, 0,
                        fmt::format("a ligament one row of points wide is a hinge under the load: {}; {}",
                                    hanging(*part), two_rows(plate))});
  return result;
}

std::vector<Refusal> unresisted_motions(const Formulation& plate) {
  const auto& found = plate.mechanisms();
  const bool twists = plate.distributed() && found.twisting > 0;  // tied by one process only
  if (!plate.held() || (found.motions == 0 && found.searched && !twists)) return {};
  return {
      {Subject::cracks, 0,
       "cracks and edges leave ligaments one row of points wide, which are hinges: what hangs by them would have the "
       "frequency 0; a finer spacing gives them two rows"}};
}

std::vector<std::string> warnings_about_mechanisms(const Formulation& plate) {
  const auto& found = plate.mechanisms();
  std::vector<std::string> warnings;
  if (found.twisting > 0)
    warnings.push_back(
        fmt::format("{} point{} bonds along one line only: the rotation about it has no stiffness and follows the next "
                    "point; {}",
                    found.twisting, found.twisting == 1 ? " has" : "s have", two_rows(plate)));
  if (found.motions > 0)
    warnings.push_back(
        found.driven ? fmt::format("{} motion{} without resistance: {}; {}", found.motions,
                                   found.motions == 1 ? "" : "s", hanging(*found.driven), two_rows(plate))
                     : fmt::format("parts that hang by bonds along one line can move in {} way{} without resistance; "
                                   "no load does so",
                                   found.motions, found.motions == 1 ? "" : "s"));
  if (!found.searched && !plate.distributed())
    warnings.push_back(
        fmt::format("bonds along one line divide the plate into {} parts, too many to look for motions "
                    "without resistance",
                    found.parts));
  return warnings;
}

}  // namespace plate
