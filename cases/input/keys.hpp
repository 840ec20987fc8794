#pragma once
#include "cases/input/key_forms.hpp"
#include "geometry/shape/outline.hpp"

namespace fracture {
struct Growth;
}

namespace plate {
struct Combination;
struct CrackFaces;
struct Discretization;
class Formula;
struct Foundation;
struct Impact;
struct Initial;
struct Load;
struct LoadCase;
struct Problem;
struct Section;
struct Spring;
struct Stiffener;
struct Support;
}  // namespace plate

namespace post {
struct SrifOptions;
}

/// The table of keys, and what is checked when the whole file is read.
namespace cases {

struct AccuracyTargets;
struct Case;
struct Output;

Fields<plate::Section> section_fields();
void check_section(const Value& section, plate::Section& content);
Fields<plate::Problem> geometry_fields();
/// Cracks of the geometry: polylines, and curves as fine polylines.
Field<plate::Problem> cracks_field();
/// A drawing of the plate, which becomes its outline, holes and cracks.
Field<plate::Problem> drawing_field();
Fields<plate::CrackFaces> crack_fields();
/// A circle or a polygon; what each is for.
Fields<geometry::Hole> hole_fields(const std::string& round, const std::string& polygonal);
void check_hole(const Value& hole, geometry::Hole& content);
Fields<plate::Discretization> discretization_fields();
Fields<plate::Support> support_fields();
Fields<plate::Load> load_fields();
Fields<plate::LoadCase> load_case_fields();
Fields<plate::Combination> combination_fields();
Fields<plate::Foundation> foundation_fields();
Fields<plate::Spring> spring_fields();
Fields<plate::Stiffener> stiffener_fields();
Fields<plate::Initial> initial_fields();
Fields<plate::Impact> impact_fields();
Fields<Analysis> analysis_fields();
Fields<fracture::Growth> growth_fields();
Fields<post::SrifOptions> srif_fields();
Fields<AccuracyTargets> accuracy_fields();
void check_accuracy(const Value& given, AccuracyTargets& targets);
Fields<Output> output_fields();
/// Calls the holes hole0, hole1 and so on.
void name_holes(plate::Problem& content);
/// Names the holes, and reports an outline that is missing.
void check_geometry_keys(const Value& geometry, plate::Problem& content);
void check_load(const Value& load, plate::Load& content);
const Words<Analysis::Kind>& analysis_kinds();
void check_analysis(const Value& analysis, Analysis& content);
void check_srif(const Value& srif, post::SrifOptions& content);

/// The root of the tree: the whole case file.
const Fields<Case>& case_fields();

/// The one table of keys: what is read, checked, documented and printed by `pdplate keys`.
const std::vector<Key>& keys();

/// Puts ends of cracks that all but touch an edge, a hole or another crack onto it, and notes that.
void snap_cracks(Case& content, Reading& reading);
/// Gives every crack one description (geometry::merged), and notes what was joined. Of a case without problems.
void merge_cracks(Case& content, Reading& reading);
/// Takes polylines that are drawn as curves are for curves (geometry::smooth_crack), and notes that. Of a case without
/// problems.
void smooth_cracks(plate::Problem& content, Reading& reading);
/// Notes a thickness that no plate has beside its sides. Of a case without problems.
void look_at_proportions(const Case& content, Reading& reading);

/// An expression in x and y.
std::optional<plate::Formula> formula_of(const Value& value);

/// Checks between tables: shape and cracks, edge names, points, what loads and holds the plate.
void check_case(const Case& content, Reading& reading);

}  // namespace cases
