#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "geometry/shape/outline.hpp"
#include "plate/model/supports.hpp"
#include "post/factors/accuracy.hpp"
#include "post/files/table.hpp"

namespace plate {
enum class AnalysisKind;
}

namespace post {

struct ProcessesSummary;

/// A force along w and the moments about the x and y axes through the origin; sums of nodal forces.
struct Wrench {
  double force = 0;                   // [force]
  double moment_x = 0, moment_y = 0;  // [force length], as theta_x and theta_y turn

  Wrench& operator+=(const Wrench& other);
};

/// Reactions of the supports of a plate at an instant, and their balance with loads and inertia (theory (67), (68)).
struct Balance {
  std::vector<Wrench> supports;   // by every holder
  Wrench loads;                   // that act
  std::optional<Wrench> inertia;  // of a motion: mass times acceleration
  /// Residual of the balance: loads and reactions less inertia, relative to the sum of the sizes of all nodal loads or
  /// to the largest reaction or the inertia, whichever is most; moments over half the diagonal of the plate.
  double residual = 0;

  Wrench sum() const;  // of the supports
};

/// Concentrated force on the plate at a corner, where Kirchhoff's theory has one.
struct CornerForce {
  std::string corner;  // names of the edges that meet there
  geometry::Point position{0, 0};
  double force = 0;                  // along w
  std::optional<double> error = {};  // estimated
};

/// The largest value along an edge of what a support does to the plate there.
struct EdgePeak {
  std::string edge, quantity;  // a column of edge_reactions.csv
  double value = 0, s = 0;     // s along the edge [length]
  geometry::Point position{0, 0};
  std::optional<double> error = {};  // estimated
};

/// Reactions of edges and pins on the plate, and their balance with the loads.
struct ReactionSummary {
  struct Support {
    std::string name;                         // of edges; of pins: pin0, pin1, ...
    std::optional<geometry::Point> position;  // of a pin, a spring or the centre of a hub

    /// The wrench as it is written: of a hub with the moments about its centre.
    Wrench written(Wrench wrench) const;
  };
  struct Largest {
    double time, force;
  };
  std::vector<Support> supports;
  double time = 0;                  // of the last row; quasi-static growth: the number of the advance
  Balance balance;                  // at this time
  double largest_residual = 0;      // of all rows
  std::vector<Largest> largest;     // force of every support, of all rows
  std::vector<Wrench> errors = {};  // estimated, of every support, as it is written; empty: not known
  /// Estimated error of them by the truncation of Lanczos vectors, relative to the largest.
  std::optional<double> truncation = {};
  // of the last row, where reactions along edges are wanted
  std::vector<EdgePeak> edges = {};
  std::vector<CornerForce> corners = {};
};

/// A part of the program that a scene uses, and what it costs.
struct ScenePart {
  std::string name;
  std::string stage;  // the entry of `seconds` that its time is in; not written
  double bytes_per_point = 0;
  double time_share = 0;  // of the total run time
};

/// An eigenfrequency; modes count from 1.
struct Frequency {
  std::size_t mode = 0;
  double frequency = 0, omega = 0;  // [1/time], 2 pi frequency
  double residual = 0;
  std::optional<double> share_in_plane = {};  // of the kinetic energy, where bending and stretching are coupled
  std::optional<double> error = {};           // estimated, of the frequency
};

/// Load factor at which a plate buckles.
struct BucklingFactor {
  std::size_t mode = 0;
  double factor = 0, residual = 0;
  std::optional<double> error;  // estimated
};

/// The largest value of a run, with its sign: K1, K2, K3 or the utilisation of a tip, the deflection w or the von Mises
/// stress of any point.
struct Peak {
  std::string quantity;
  std::optional<std::size_t> tip;
  double value = 0, time = 0;               // in motion
  std::optional<geometry::Point> position;  // of the point
  std::optional<double> outside;     // no nearer than this to tips, sharp corners, pins and point forces [length]
  std::optional<double> error = {};  // estimated
};

/// A value of a plate at rest at a probe: w, theta_x, theta_y, u, v, a moment, a force or the von Mises stress.
struct ProbeValue {
  std::string probe, quantity;
  geometry::Point position;
  double value = 0;
  std::optional<double> error = {};  // estimated
};

/// The largest von Mises stress at a distance from a place at which a plate has no finite stress.
struct StressAtDistance {
  std::string place;                    // "tip 0", "corner", "pin0", "spring", "point force", "impact"
  geometry::Point singular;             // the place
  double distance = 0;                  // [length]
  double value = 0;                     // [force/length^2]
  geometry::Point position = singular;  // where it is
  bool resolved = true;                 // by the points; what is not is not written
  std::optional<double> error = {};     // estimated
};

/// The faces behind a tip in the rows of a run: post/report/overlaps.hpp.
struct FaceOverlaps {
  std::size_t tip;
  geometry::Point position;                                               // first
  std::size_t rows = 0, above = 0;                                        // all, those with K1 < 0
  std::optional<double> first_above = {}, first_change = {}, least = {};  // times; the least K1 where it is negative
};

/// Summary of a plate in its plane.
struct MembraneSummary {
  struct Reaction {
    std::string name;                  // of the support
    geometry::Point force;             // on the plate [force]
    std::optional<double> error = {};  // estimated, of either component
  };
  double strain_energy = 0, external_work = 0;
  double residual = 0;               // of the equilibrium, relative
  double largest_displacement = 0;   // sqrt(u^2 + v^2) of any point [length]
  std::optional<double> error = {};  // estimated, of the largest displacement
  std::vector<Reaction> reactions;
};

/// Contact of the faces of cracks.
struct ContactSummary {
  double least_opening = 0;     // of the faces, at either face of the plate [length]
  double largest_pressure = 0;  // along the crack, at a face of the plate [force/length]
  double closed_share = 0;      // of the length of the cracks
};

/// Load case, or a combination of some.
struct LoadCaseSummary {
  std::string name;
  std::vector<std::pair<std::string, double>> of = {};  // of a combination
  std::optional<std::size_t> iterations = {};           // of a load case, or with large deflections
  std::optional<double> residual = {};                  // relative; of a combination at most this
  std::vector<Srif> srif = {};
  std::vector<FaceFactors> faces = {};  // of every entry of srif
  std::vector<Peak> extremes = {};
  std::vector<ProbeValue> probes = {}, lines = {};
  std::vector<StressAtDistance> stress_near = {};
  std::optional<ReactionSummary> reactions = {};
  double strain_energy = 0, external_work = 0;
  std::optional<MembraneSummary> membrane = {};  // where loads of any load case act in the plane
  bool large_deflections = false;                // solved by itself, also a combination
  std::optional<ContactSummary> contact = {};    // where faces of cracks may touch: solved by itself
  // of strain_energy, where bending and stretching are coupled: bending, stretching, coupling
  std::vector<std::pair<std::string, double>> energy_parts = {};
  std::optional<double> energy_error = {};           // estimated, of strain_energy
  std::optional<plate::LiftedSupports> lifted = {};  // where supports only push

  /// True of a combination that is the sum of states.
  bool superposed() const { return !of.empty() && !large_deflections && !contact; }
};

/// The largest of all load cases and combinations: K1, K2, K3, G, N1, N2 or the utilisation of a tip, and which of them
/// gives it.
struct EnvelopeEntry {
  std::size_t tip;
  geometry::Point position;
  std::string quantity;
  double value;
  std::optional<double> error;  // estimated
  std::string of;
};

/// The largest amplitude of a quantity at a place, of a response over frequencies.
struct ResponsePeak {
  std::string place, quantity;
  double amplitude, frequency;  // [1/time]
  std::optional<double> error;  // estimated, of the amplitude
};

/// Summary of a growth of cracks.
struct GrowthSummary {
  std::string outcome;
  std::size_t advances = 0;
  std::optional<double> first_load_factor;             // quasi-static: at which the first tip moved; 0 where none did
  std::optional<double> largest_load_factor;           // quasi-static
  std::optional<double> spent;                         // energy taken over fracture energy and area of the new crack
  std::optional<double> largest_speed;                 // in motion, of a piece of crack [length/time]
  std::optional<std::size_t> broken_bonds;             // where bonds break one by one
  std::vector<double> lengths;                         // of every crack at the end [length]
  std::optional<double> first_load_factor_error = {};  // estimated, of tips
  bool resolved = true;                                // false: it stopped as its next advance is not resolved
};

/// Summary of the search for the discretisation.
struct AccuracySummary {
  double asked = 0;
  std::optional<double> reached;  // estimated, of all tips
  std::string ended_by;           // what ended it before `asked` was reached; empty where it was
  std::vector<AccuracyStep> path;

  /// "reached", or what ended the search, as files have it.
  std::string outcome() const { return ended_by.empty() ? "reached" : ended_by; }
};

/// Search for the discretisation by which results are known to the shares that are asked.
struct TargetsSummary {
  struct Target {
    std::string of;                      // "deflection", "stress", "reactions", "frequencies"
    double asked;                        // share of the result
    std::optional<double> reached = {};  // estimated error of the worst, likewise
  };
  struct Step {
    std::size_t points = 0;
    double spacing = 0;                                         // [length]
    std::optional<double> tip_spacing = {}, hole_spacing = {};  // [length]
    double seconds = 0;
    std::vector<Target> targets = {};  // what was reached then
  };
  std::vector<Target> targets;
  std::string ended_by = {};  // what ended it before; empty where all were reached
  std::vector<Step> path = {};

  std::string outcome() const { return ended_by.empty() ? "reached" : ended_by; }
};

/// Content of summary.json; cases/files.md documents every field.
struct Summary {
  std::string title, outcome, version, digest;
  std::string units;                            // "SI" or "none"
  std::string formulation, formulation_reason;  // "ordinary" or "galerkin", and why
  std::string recipe;                           // of the case, with its keys; empty: none
  std::size_t points = 0, bonds = 0;            // of the plate; bonds counted from both ends, intact at the end
  std::size_t fictitious_points = 0, fictitious_bonds = 0;  // outside the plate, for supports
  double spacing = 0, horizon = 0;
  struct Matched {
    std::size_t exact, blended, arbitrary_horizon;
  };
  std::optional<Matched> position_aware;  // points by how their weights could be matched
  struct Analysis {
    plate::AnalysisKind kind{};
    std::string method, stop_reason;
    std::optional<std::string> preconditioner;
    std::optional<std::size_t> iterations, steps;
    std::optional<double> residual, tolerance, time_step, time_step_limit, duration;
  } analysis;
  std::vector<std::pair<std::string, double>> seconds;  // geometry, families, parameters, solve, srif, output, total
  std::size_t peak_memory_bytes = 0;
  std::size_t own_points = 0;                         // of this rank, where the plate is distributed; not written
  std::shared_ptr<const ProcessesSummary> processes;  // where the plate is distributed
  std::vector<Srif> srif;
  std::vector<FaceFactors> faces;                      // of every entry of srif
  std::optional<double> toughness;                     // of the case
  std::vector<FaceOverlaps> overlaps;                  // of a motion or a growth
  std::vector<Peak> peaks;                             // of a motion
  std::vector<Peak> extremes;                          // in statics
  std::vector<ProbeValue> probes;                      // in statics, of one load
  std::vector<ProbeValue> lines;                       // integrals along lines, likewise
  std::vector<StressAtDistance> stress_near;           // singular places, likewise
  std::optional<double> energy_error;                  // estimated, of the strain energy
  std::optional<ReactionSummary> reactions;            // of a plate that is held
  std::vector<LoadCaseSummary> load_cases;             // then combinations
  std::vector<EnvelopeEntry> envelope;                 // of them
  std::optional<double> deflection_over_thickness;     // the largest of the run
  std::optional<double> linear_theory_off;             // in statics: estimated share by which it is too large
  std::optional<double> touching;                      // share of the unilateral foundations which is pressed
  std::optional<plate::LiftedSupports> lifted;         // where supports only push, of one load
  std::optional<double> multipliers;                   // the forces that they add, over the loads
  std::optional<AccuracySummary> accuracy;             // of a case that asks for it
  std::optional<TargetsSummary> targets;               // likewise, of results other than factors
  std::vector<Frequency> frequencies;                  // of a frequency analysis
  std::vector<BucklingFactor> buckling;                // of a buckling analysis
  Table load_steps;                                    // of large deflections, as load_steps.csv
  std::vector<ResponsePeak> response;                  // of a harmonic analysis
  std::vector<double> resonances;                      // likewise, within the sweep [1/time]
  std::optional<GrowthSummary> growth;                 // of a case with growth
  std::optional<MembraneSummary> membrane;             // where loads act in the plane
  std::optional<ContactSummary> contact;               // where faces of cracks may touch
  std::vector<std::pair<std::string, double>> energy;  // strain, kinetic, external_work, fracture
  std::vector<ScenePart> scene;
  std::vector<std::string> warnings;
};

/// Results of the same case by other points.
struct OtherResults {
  Summary summary;
  double share = 1;              // of the difference that is the error of a result
  double of_largest_stress = 2;  // times that is the error of the largest stress, which is at an edge as a rule
  double floor = 0.3;            // of the largest relative error of moments and forces that each of them has at least
};

std::string to_json(const Summary& summary);

/// Peak resident memory of this process [bytes].
std::size_t peak_memory_bytes();

}  // namespace post
