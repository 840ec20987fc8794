#pragma once
#include <functional>
#include <memory>
#include <optional>

#include "plate/model/numerical_method.hpp"
#include "plate/model/state.hpp"
#include "post/files/summary.hpp"
#include "post/files/table.hpp"

namespace plate {
class Formulation;
class Inertia;
class Operator;
struct Boundary;
struct Instant;
}  // namespace plate

namespace post {

struct Response;
class Recorder;

/// Wrench of the nodal force `value`, conjugate to w (component 0) or a rotation (1, 2), at a place.
Wrench wrench(const geometry::Point& at, std::size_t component, double value);

/// Nodal forces as the balance sees them.
struct Applied {
  Wrench sum;
  double size = 0;       // sum of the sizes of all, couples over half the diagonal of the plate [force]
  Eigen::VectorXd held;  // on what is held

  void add(double factor, const Applied& other);
};

/// Reaction on a piece of an edge, about the middle of the piece, per length; n is the outward normal, s along the way.
struct EdgeValue {
  double s = 0;                    // of the middle [length]
  geometry::Point position{0, 0};  // of the middle
  double length = 0;               // of the piece
  double force = 0;                // along w [force/length]
  double moment = 0, twist = 0;    // M_nn and M_ns [force]
  double kirchhoff_force = 0;      // force with the twist as forces, without those at corners [force/length]
};

struct EdgeCurve {
  std::string edge;
  std::vector<EdgeValue> values;
};

/// Reactions along the sides that edges hold, s running over all sides of a name, and at their corners.
struct EdgeReactions {
  std::vector<EdgeCurve> curves;
  std::vector<CornerForce> corners;
};

/// The reactions of a plate by edges and pins, from what its forces leave on what is held, and by foundations and
/// springs. What two hold together, as
/// the point at a corner of two edges, is shared equally between them.
class Supports {
public:
  /// `boundary` must outlive this.
  explicit Supports(const plate::Boundary& boundary);

  Applied nothing() const;
  /// Applied forces, not carried over to the free degrees of freedom.
  Applied applied(const plate::Forces& forces) const;
  /// Balance with the reactions of edges and pins, then of foundations and springs. `internal`: force -K u on the held
  /// degrees of freedom; `loads`: that act; `inertia`: mass times acceleration, in motion; `state`: u.
  Balance balance(const Eigen::VectorXd& internal, const Applied& loads, const Applied* inertia,
                  const plate::State& state) const;
  /// Forces of the supports on what they hold; arguments as of balance().
  Eigen::VectorXd reaction(const Eigen::VectorXd& internal, const Applied& loads, const Applied* inertia) const;
  /// Reactions on `pieces` equal pieces of every side that an edge holds; collective. The wrenches of the pieces add up
  /// to the row of the edge in balance(). A corner force is what the ends of both edges, which are `layer` [length] or
  /// three spacings long, carry more than the smooth curve beside them, with twist as forces.
  EdgeReactions along_edges(const Eigen::VectorXd& reaction, std::size_t pieces, double layer) const;
  /// Elastic forces of the plate along w on every support, as functionals of its state [supports x 3 points, as
  /// State::data()]; where there are many supports, their sum.
  Eigen::MatrixXd elastic_forces(const plate::Operator& plate) const;

private:
  /// Wrench on a holder by a unit force on a degree of freedom that it holds, with what the leaders of that degree of
  /// freedom take.
  struct Share {
    std::uint32_t holder, held;  // number among those that are held
    Wrench unit;
  };
  std::vector<std::size_t> sides_of(const Share& share) const;

  const plate::Boundary* boundary_;
  std::vector<Share> shares_;  // by holders
  geometry::Point centre_{0, 0};
  double arm_ = 0;  // half the diagonal of the plate
};

/// Reactions of a damped plate that vibrates at one frequency after another.
class HarmonicReactions {
public:
  /// `plate` must outlive this.
  HarmonicReactions(const plate::Formulation& plate, const plate::Damping& damping);
  /// Reactions of a plate with its plane: `stiffness`, which must outlive this, and mass are of stacked states, as
  /// those of at() and functionals() then are.
  HarmonicReactions(const plate::Formulation& plate, const plate::Damping& damping, const plate::Operator& stiffness,
                    plate::Inertia inertia);
  ~HarmonicReactions();

  /// Force and moments of every support, (A + i B) with the load as its real part, for the state (A + i B).
  std::vector<Response> at(double frequency, const plate::State& in_phase, const plate::State& quadrature) const;
  /// Functionals of the state that the forces along w are (Supports::elastic_forces()); no rows without supports.
  const Eigen::MatrixXd& functionals() const { return functionals_; }
  /// `change`: what the vectors leave of the functionals, relative to the largest.
  void known_to(double change) { change_ = change; }

private:
  struct Moving;

  const plate::Formulation& plate_;
  const plate::Operator& stiffness_;
  plate::Damping damping_;
  std::vector<ReactionSummary::Support> supports_;
  std::unique_ptr<const Moving> moving_;
  Eigen::MatrixXd functionals_;
  double change_ = 0;
};

/// The reactions of a run, row by row: what edges, pins, foundations and springs do to the plate. No
/// rows of a plate that nothing holds.
class ReactionRows {
public:
  /// Constructs the rows of plates that change from row to row.
  ReactionRows() = default;
  /// Constructs the rows of one plate, which must outlive this. `rotary`: factor of the rotary inertia;
  /// `mass_of_cells`: Lanczos vectors move it; `drag`: alpha of its damping, whose forces count as inertia.
  ReactionRows(const plate::Formulation& plate, double rotary, bool mass_of_cells, double drag = 0);

  /// Adds a row of the plate of the constructor: under all of its loads where nothing moves. `forces`: the plate as it
  /// is now, where bonds may have broken.
  void add(const plate::Instant& now, const plate::Operator& forces);
  /// Adds a row of a plate in equilibrium under a share of all loads.
  void add(double time, const plate::Formulation& plate, const plate::Operator& forces, const plate::State& state,
           double share);

  /// Adds a row of a plate in equilibrium under a load.
  void add(double time, const plate::Formulation& plate, const plate::Operator& forces, const plate::State& state,
           const plate::Forces& load);

  /// Also takes the reactions along edges, on so many pieces of each, of rows of plates at rest that follow.
  void along_edges(std::size_t pieces) { pieces_ = pieces; }

  /// Sets the truncation by the Lanczos vectors that move the plate: ReactionSummary::truncation.
  void truncated(double share) { truncation_ = share; }

  bool empty() const { return balances_.empty(); }
  /// The rows of reactions.csv.
  Table table() const;
  /// The rows of edge_reactions.csv and corner_forces.csv; without rows where they are not taken.
  const Table& edges() const { return edges_; }
  const Table& corners() const { return corners_; }
  std::optional<ReactionSummary> summary() const;

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(supports_, balances_, edges_, corners_);
  }

private:
  void add_at_rest(double time, const plate::Formulation& plate, const plate::Operator& forces,
                   const plate::State& state, const std::function<Applied(const Supports&)>& loads);
  void take_edges(double time, const EdgeReactions& found);

  /// Moving plate.
  struct Moving;

  std::vector<ReactionSummary::Support> supports_;
  std::vector<std::pair<double, Balance>> balances_;
  std::optional<double> truncation_;
  std::size_t pieces_ = 0;  // of every edge
  Table edges_, corners_;
  EdgeReactions along_edges_;  // of the last row
  // of one plate:
  const plate::Formulation* plate_ = nullptr;
  double rotary_ = 1, drag_ = 0;
  bool mass_of_cells_ = false;
  std::shared_ptr<const Moving> moving_;  // once it does
};

/// Records the tables that have rows.
void record(const ReactionRows& rows, Recorder& recorder);

}  // namespace post
