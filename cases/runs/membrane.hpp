#pragma once
#include <string>
#include <vector>

#include "post/factors/tip_methods.hpp"
#include "post/files/frame.hpp"
#include "post/files/summary.hpp"

namespace plate {
class Formulation;
struct CoupledEquilibrium;
struct LargeDeflections;
struct PlateLoads;
struct LoadStep;
struct Stretch;
struct Analysis;
struct Heat;
struct StaticResult;
struct StaticSolution;
struct TouchingFaces;
enum class LoadControl : bool;
}  // namespace plate

namespace fracture {
class DamagedPlate;
}

namespace cases {

struct Case;

/// A plate in its plane, at rest under its loads.
struct MembraneResult {
  post::InPlaneFields fields;
  plate::Resultants forces;         // the membrane forces as moments (PlateLaw::membrane)
  std::vector<post::Srif> factors;  // N1 and N2 as K1 and K2
  post::MembraneSummary summary;
  std::vector<std::string> warnings;
  std::optional<plate::Resultants> of_both = {};  // moments of a section that couples
  double stored = 0;                              // by heat, in both energies of the summary (plate::stored)
};

/// Factors that are wanted of a plate in its plane. Without `options` none are.
struct MembraneFactorsWanted {
  const std::optional<post::SrifOptions>& options;
  const std::vector<post::TipMethods>& methods;
  bool all_rings = true;
  std::vector<double>* largest = nullptr;          // of a motion: the largest factor of every tip at earlier times
  const std::vector<post::Srif>* known = nullptr;  // the factors, where they are known already
};

/// Solves a plate in its plane under all its loads. `solved`: its equilibrium, where that is known already.
/// @throws plate::NumericalError  no equilibrium within the tolerance, or a number is not finite
MembraneResult membrane_at_rest(const plate::Formulation& membrane, const plate::Analysis& analysis,
                                const MembraneFactorsWanted& wanted, const plate::StaticResult* solved = nullptr);

/// Results of a plate in its plane in a state of equilibrium under a load. `where`: in messages;
/// `heat`: among the load; `stretch`: of its middle plane by the deflections; `damaged`: with the bonds that have
/// broken, null: none have.
/// @throws plate::NumericalError  a number is not finite
MembraneResult membrane_results(const plate::Formulation& membrane, const plate::State& state,
                                const plate::Forces& load, const plate::Heat& heat, const MembraneFactorsWanted& wanted,
                                const std::string& where = "in the plane", const plate::Stretch* stretch = nullptr,
                                const fracture::DamagedPlate* damaged = nullptr);

/// Findings on contact of the faces of cracks.
struct FacesFound {
  post::ContactSummary summary;
  post::Table faces;                    // contact.csv
  std::vector<post::ClosedTip> closed;  // of every tip
};
FacesFound faces_found(const plate::TouchingFaces& found, const plate::Formulation& plate);

/// Equilibrium of a plate in its plane with contact of the faces of its cracks.
struct ContactResult {
  MembraneResult in_plane;
  FacesFound faces;
  std::size_t factor_bytes = 0;
};

/// Finds where faces of cracks touch, solves for the plate in its plane, and adds to `bending`, a state without
/// contact, what contact changes.
/// @throws plate::NumericalError  as membrane_at_rest() and plate::touching_faces()
ContactResult with_contact(const plate::Formulation& plate, const plate::Formulation& membrane,
                           const plate::Analysis& analysis, const MembraneFactorsWanted& wanted,
                           plate::StaticResult& bending);

/// States of a plate and of its plane.
struct StatesOfBoth {
  const plate::State &bending, &membrane;
};
/// Completes moments and membrane forces of a section that couples, where the middle plane has these strains by the
/// deflections [3 x points], and heat; of other sections nothing changes.
void couple(MembraneResult& result, const plate::Formulation& plate, const plate::Formulation& membrane,
            const StatesOfBoth& states, const Eigen::Matrix3Xd& strains, const plate::Heat& heat);

/// Results in the plane of an equilibrium with large deflections, with the strains that the deflections add.
/// `in_plane`: the load there, with `heat`; `where`: in messages.
/// @throws plate::NumericalError  a number is not finite
MembraneResult membrane_results(const plate::Formulation& plate, const plate::Formulation& membrane,
                                const plate::LargeDeflections& found, const plate::Forces& in_plane,
                                const plate::Heat& heat, const MembraneFactorsWanted& wanted, const std::string& where);

/// Results in the plane of an equilibrium of a plate whose bending and stretching are coupled.
/// @throws plate::NumericalError  a number is not finite
MembraneResult membrane_results(const plate::Formulation& plate, const plate::Formulation& membrane,
                                const plate::CoupledEquilibrium& found, const plate::PlateLoads& loads,
                                const plate::Heat& heat, const MembraneFactorsWanted& wanted, const std::string& where);

/// Fields in the plane of a shape of a coupled plate, without loads.
MembraneResult results_of_shape(const plate::Formulation& plate, const plate::Formulation& membrane,
                                const StatesOfBoth& shape, const plate::Heat& heat, const std::string& where);

/// Work of the supports of a coupled plate that have moved slowly, by `lift`. `across`: the load of the plate.
double work_of_supports(const plate::Formulation& plate, const plate::CoupledEquilibrium& found,
                        const plate::Forces& across, const plate::State& lift);

/// The rows of load_steps.csv; by arc length with the columns of the path.
post::Table load_steps(const std::vector<plate::LoadStep>& steps, plate::LoadControl control = {});

/// Warnings about an equilibrium with large deflections that was not reached as loads grow, is not stable, or is beyond
/// the theory. `stored`: by heat.
std::vector<std::string> warnings_about(const plate::LargeDeflections& found, double stored, const Case& c);

/// Checks a solution of a plate in its plane.
/// @throws plate::NumericalError  no equilibrium within the tolerance, or a number is not finite
void require_equilibrium(const plate::Formulation& membrane, const plate::StaticSolution& solution, double tolerance,
                         const std::string& where);

/// Warns or throws where the strain energy differs from the work of the loads, for formulations whose forces are no
/// derivative of an energy: the difference tells how coarse the points are. Measured with surface nodes, seven kinds of
/// support, horizons of 0.7 to 2 thicknesses: deflections 4 % off where they are 34 % apart.
void look_for_coarseness(double strain, double work, const plate::Formulation& plate,
                         std::vector<std::string>& warnings);

/// True of a plate that heat does not move but for rounding: held all round, it has the energy that heat stores.
bool only_stored(double strain_energy, double stored);

/// Checks the energy of a plate in its plane at rest, without what heat stores.
/// @throws plate::NumericalError  it is not the work of the loads
void require_balance(const MembraneResult& result, const std::string& where);

/// Estimates by what share linear theory overstates the deflections of a plate at rest (plate::linear_theory_off).
/// `membrane`, `in_plane`: its plane and the load there, with `heat`, where there is one; null and without columns
/// otherwise. Absent where deflections are small or beyond any estimate, and for plates that have no large deflections.
/// Beyond 5,000 points a plate of 2,500 points is solved for it; with load cases none is found beyond 20,000.
std::optional<double> linear_theory_off(const plate::Formulation& plate, const plate::State& state,
                                        const plate::Formulation* membrane, const plate::Forces& in_plane,
                                        const plate::Heat& heat);
/// Estimates it under all loads of the plane.
std::optional<double> linear_theory_off(const plate::Formulation& plate, const plate::State& state,
                                        const plate::Formulation* membrane = nullptr);

/// Adds the fields of a plate in its plane to a frame of its bending; the von Mises stress becomes that of the worse
/// face under both.
void add_in_plane(post::Frame& frame, const plate::Formulation& plate, const plate::Formulation& membrane,
                  const MembraneResult& result);

/// A warning of post about factors of a plate in its plane, whose K1 and K2 are N1 and N2.
std::string of_plane(std::string warning);

/// Warnings about cracks whose faces loads in the plane press together: without contact they are taken as free.
/// `known`: the plane under these loads.
/// @throws plate::NumericalError  as membrane_at_rest()
std::vector<std::string> warnings_about_pressed_faces(const plate::Formulation& membrane, plate::Analysis analysis,
                                                      const plate::State* known = nullptr);

/// Warning about rotations to which von Karman's strains do not hold.
std::vector<std::string> warnings_about_rotations(double largest);

/// Warnings about tips at which the faces of the crack overlap at z > 0, by bending and membrane forces together.
/// `may_touch`: the run could find their contact.
std::vector<std::string> warnings_about_overlaps(const std::vector<post::Srif>& srifs, bool may_touch);

/// True where `contact = true` would be taken by a case as it is.
bool may_touch(const Case& c, const plate::Formulation& plate);

}  // namespace cases
