// Bode's thesis (Peridynamic Galerkin methods), small strains in the plane: patch tests, modes, rates of convergence,
// inf-sup values, nearly incompressible problems, coupling with elements.

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "cases/papers/bodies/galerkin/tasks.hpp"
#include "cases/papers/paper_rows.hpp"

namespace cases {
namespace {

namespace gs = galerkin_systems;

constexpr double moved_by = 0.3;       // of points, in spacings
constexpr double passed_below = 1e-9;  // of patch tests, whose strains are 0.1 to 0.4

const gs::Solid thesis_solid{100, 0.3};  // of 7.2.2, 7.2.3

post::Series numbered_series(const std::string& label, std::size_t number, post::Curve curve) {
  return {.label = label, .line = post::Line::numbered, .curve = std::move(curve), .number = number};
}

// ---------------------------------------------------------------------------------------------- 7.2.2 patch tests

/// A row of the thesis' tables 7.2 and 7.3: norms of the error as printed, and ours.
struct PatchRow {
  std::string table, method;
  gs::Norms published;
  std::function<gs::Norms()> ours;
};

void add_patch(PaperResults& results, const PatchRow& row) {
  const ProcessorWatch watch;
  const gs::Norms ours = row.ours();
  const bool passes = row.published.L2 < passed_below;
  const auto claim = [&](double norm) {
    return Claim{passes ? "passes the patch test" : "fails the patch test", (norm < passed_below) == passes};
  };
  const std::string item = fmt::format("table {}, {}", row.table, row.method);
  const auto add = [&](const std::string& norm, double own, double published) {
    auto& result = results.add(watch, item, norm, own, 0, "the field itself");
    result.published = published, result.claim = claim(own);
  };
  add("L2 norm of the error [m^2]", ours.L2, row.published.L2);
  add("H1 norm of the error [m]", ours.H1, row.published.H1);
}

/// The square of 37 x 37 irregular points; the thesis has 1345.
void add_patches(PaperResults& results) {
  const gs::Body near = gs::body({2, 2, 36, 36, moved_by, gs::Reach::cells}),
                 wide = gs::body({2, 2, 36, 36, moved_by, gs::Reach::two_cells});
  const gs::System u1 = gs::linear_static(wide), unl = gs::moving(wide);
  const auto linear = [&](const gs::Body& b, const gs::Sparse& K, const gs::System& test, bool corrected) {
    return gs::patch_norms(thesis_solid, b, K, corrected ? gs::nodal_normals(b, test) : b.normals, gs::linear_field(),
                           {0, 0});
  };
  const auto test = [&](const gs::Correction& correction, gs::Normals normals) {
    return gs::variationally_consistent(wide, u1, correction, normals);
  };
  const auto petrov = [&](const gs::System& t, bool corrected = true) {
    return linear(wide, gs::petrov_stiffness(gs::law(thesis_solid), wide, unl, t, gs::Petrov::first), t, corrected);
  };
  const auto mixed = [&](const gs::System& t, const gs::System& dilation, bool corrected = true) {
    return linear(wide, gs::petrov_constant_pressure(thesis_solid, wide, t, dilation), t, corrected);
  };
  const auto bubnov = [&](const gs::System& s, bool corrected) {
    return linear(near, gs::plane_stiffness(thesis_solid, near, s), s, corrected);
  };
  const auto quadratic = [&](const gs::Sparse& K) {
    return gs::patch_norms(thesis_solid, wide, K, wide.normals, gs::quadratic_field(),
                           gs::quadratic_body_force(thesis_solid));
  };
  const auto first = [&](const gs::System& t) {
    return quadratic(gs::petrov_stiffness(gs::law(thesis_solid), wide, unl, t, gs::Petrov::first));
  };
  using N = gs::Normals;
  const auto &V1 = gs::constant_correction, &V2 = gs::second_derivative_correction, &V3 = gs::linear_correction;
  const std::vector<PatchRow> rows{
      {"7.2", "PPG Unl", {9.532e-2, 2.336e-1}, [&] { return petrov(u1, false); }},
      {"7.2", "VCPPG V1sn Unl", {2.146e-15, 2.330e-14}, [&] { return petrov(test(V1, N::found_across)); }},
      {"7.2", "VCPPG V2sn Unl", {7.596e-16, 8.125e-15}, [&] { return petrov(test(V2, N::found_across)); }},
      {"7.2", "VCPPG V3p Unl, no point fixed", {9.602e-17, 1.013e-15}, [&] { return petrov(test(V3, N::given)); }},
      {"7.2", "VCPPG V3s Unl", {7.629e-17, 9.868e-16}, [&] { return petrov(test(V3, N::found)); }},
      {"7.2", "VCPPG V3sn Unl", {6.489e-17, 9.974e-16}, [&] { return petrov(test(V3, N::found_across)); }},
      {"7.2", "PPG UnlP0", {8.557e-2, 2.513e-1}, [&] { return mixed(u1, unl, false); }},
      {"7.2",
       "VCPPG V1sn UnlP0, dilation by Unl",
       {6.040e-3, 2.299e-2},
       [&] { return mixed(test(V1, N::found_across), unl); }},
      {"7.2",
       "VCPPG V1sn UnlP0, dilation by the test functions",
       {6.040e-3, 2.299e-2},
       [&] { return mixed(test(V1, N::found_across), test(V1, N::found_across)); }},
      {"7.2", "VCPPG V2sn UnlP0", {1.652e-15, 1.353e-14}, [&] { return mixed(test(V2, N::found_across), unl); }},
      {"7.2", "VCPPG V3sn UnlP0", {4.370e-14, 4.117e-13}, [&] { return mixed(test(V3, N::found_across), unl); }},
      {"7.2", "PBG Unl", {8.563e-3, 1.284e-1}, [&] { return bubnov(gs::moving(near), false); }},
      {"7.2",
       "VCPBG V5sn Unl",
       {2.518e-14, 1.154e-12},
       [&] { return bubnov(gs::variationally_consistent(near, gs::moving(near), V3, N::found_across), true); }},
      {"7.3", "PPG Unl", {1.757e-1, 3.658e-1}, [&] { return first(u1); }},
      {"7.3", "VCPPG V3 Unl", {5.950e-4, 1.861e-2}, [&] { return first(test(V3, N::given)); }},
      {"7.3", "VC2PPG V1s U2", {6.674e-16, 1.075e-14}, [&] {
         return quadratic(gs::petrov_stiffness(gs::law(thesis_solid), wide, gs::quadratic_static(wide),
                                               gs::second_order_consistent(wide, u1), gs::Petrov::second));
       }}};
  for (const auto& row : rows) add_patch(results, row);
}

// ------------------------------------------------------------------------------------------------- 7.2.1 modes

constexpr Eigen::Index first_elastic = 3;  // after the rigid motions

/// Free block of 20 x 10 cells.
Eigen::MatrixXd block_stiffness(const gs::Basis& basis) {
  const gs::Solid solid{100, 0.4};
  const gs::Body block = gs::body({20, 10, 20, 10, 0, basis.reach});
  return gs::condensed(solid, gs::blocks(solid, block, basis));
}

/// Number, from 1, of the mode that is most like the elements' first elastic one.
Eigen::Index first_physical(const Eigen::MatrixXd& modes, const Eigen::MatrixXd& of_elements) {
  Eigen::Index number = 0;
  (modes.transpose() * of_elements.col(first_elastic)).cwiseAbs().maxCoeff(&number);
  return number + 1;
}

/// The thesis on a formulation of its figure 7.6; `worst` is the largest relative difference of the first seven elastic
/// eigenvalues from those of elements.
std::optional<Claim> modes_claim(const std::string& name, double low, double worst) {
  if (name == "VC U1") return Claim{"plenty of modes with low energy", low > 100};
  if (name.find("CA") != std::string::npos || name.find("P1C") != std::string::npos) return std::nullopt;
  return Claim{"in good agreement with elements at low stiffness", worst < 0.15};
}

void add_modes(PaperResults& results) {
  using Modes = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>;
  const Modes elements(block_stiffness({"Q1", gs::Reach::cells, gs::bilinear}));
  post::Panel panel{"number of the mode", "eigenvalue [N/mm]", {}};
  const auto curve = [](const Eigen::VectorXd& values) {
    post::Curve c;
    for (Eigen::Index i = 0; i < 200; ++i) c.t.push_back(double(i + 1)), c.y.push_back(values[i]);
    return c;
  };
  panel.series.push_back(
      {.label = "bilinear elements", .line = post::Line::reference, .curve = curve(elements.eigenvalues())});
  gs::Basis wide = gs::basis("VC Unl");
  wide.name += ", families of 2.51 spacings", wide.reach = gs::Reach::circle;
  std::vector<gs::Basis> all{wide};
  for (const char* name : {"VC U1", "VC Unl", "VC UnlP0", "VC U1SIG", "VC Unl+P1C", "PG-CA"})
    all.push_back(gs::basis(name));
  for (std::size_t number = 0; number < all.size(); ++number) {
    const ProcessorWatch watch;
    const Modes modes(block_stiffness(all[number]));
    const Eigen::VectorXd& values = modes.eigenvalues();
    const std::string item = "7.2.1 modes of a free block, " + all[number].name;
    const bool soft = all[number].name == "VC U1";
    panel.series.push_back(numbered_series(all[number].name, number, curve(values)));
    const double zero = 1e-11 * values.tail(1)[0];
    const auto low = (values.array() < elements.eigenvalues()[19]).count();
    const double worst =
        (values.segment(first_elastic, 7).array() / elements.eigenvalues().segment(first_elastic, 7).array() - 1)
            .abs()
            .maxCoeff();
    results.add(watch, item, "zero modes [-]", double((values.array().abs() < zero).count()), 3, "rigid motions")
        .published = 3;
    results.add(watch, item, "modes below the 20th of elements [-]", double(low), 19, "bilinear elements").claim =
        modes_claim(all[number].name, double(low), worst);
    results.add(watch, item, "first elastic eigenvalue [N/mm]", values[first_elastic],
                elements.eigenvalues()[first_elastic], "bilinear elements");
    results
        .add(watch, item, "number of the first physical mode [-]",
             double(first_physical(modes.eigenvectors(), elements.eigenvectors())), 4, "bilinear elements")
        .published = soft ? std::optional<double>(100) : std::nullopt;
  }
  results.panels.push_back(panel);
}

// ------------------------------------------------------------------------------------- 7.2.3 rates of convergence

/// A way to solve the manufactured problem: displacements, and the gradients that are read at the masters.
struct RateWay {
  std::string name;
  gs::Reach reach;
  std::function<std::pair<Eigen::VectorXd, gs::System>(const gs::Body&, const Eigen::VectorXd& load,
                                                       const Eigen::VectorXd& held)>
      solve;
  bool optimal = true;  // by the thesis
};

RateWay way_of(const gs::Basis& basis, bool optimal, const std::function<gs::System(const gs::Body&)>& read) {
  const auto solve = [=](const gs::Body& b, const Eigen::VectorXd& load, const Eigen::VectorXd& held) {
    return std::pair{gs::solution(thesis_solid, gs::blocks(thesis_solid, b, basis), load, held).u, read(b)};
  };
  return {basis.name, basis.reach, solve, optimal};
}

/// PPG Unl, with correction V3 or without; the trial's gradients are read.
RateWay petrov_way(bool corrected) {
  const auto solve = [=](const gs::Body& b, const Eigen::VectorXd& load, const Eigen::VectorXd& held) {
    const gs::System u1 = gs::linear_static(b), trial = gs::moving(b);
    const gs::System test = corrected ? gs::variationally_consistent(b, u1) : u1;
    const auto K = gs::petrov_stiffness(gs::law(thesis_solid), b, trial, test, gs::Petrov::first);
    return std::pair{gs::solved_by_lu(K, load, held), trial};
  };
  return {corrected ? "VCPPG V3 Unl" : "PPG Unl", gs::Reach::cells, solve, corrected};
}

std::vector<RateWay> rate_ways() {
  std::vector<RateWay> all{way_of({"bilinear elements", gs::Reach::cells, gs::bilinear}, true, gs::central_average)};
  for (const char* name : {"PG-CA", "VC Unl", "VC U1SIG", "VC Unl+P1C", "Unl"}) {
    const gs::Basis& basis = gs::basis(name);
    all.push_back(way_of(basis, std::string(name) != "Unl", basis.system));
  }
  all.push_back(petrov_way(true));
  all.push_back(petrov_way(false));
  return all;
}

/// Errors on a series of spacings.
struct Rates {
  std::vector<double> spacings, L2, H1, seconds;
};

Rates rates(const RateWay& way, double perturbation) {
  Rates r;
  const gs::Field field = gs::manufactured_field();
  for (const int cells : {8, 16, 32, 64}) {
    const gs::Body b = gs::body({2, 2, cells, cells, perturbation, way.reach});
    Eigen::VectorXd load(2 * b.points.cols()), held = gs::nothing_prescribed(load.size());
    for (Eigen::Index k = 0; k < b.points.cols(); ++k)
      load.segment<2>(2 * k) = b.areas[k] * gs::manufactured_body_force(thesis_solid, b.points.col(k));
    for (const auto& edge : b.outline) held.segment<2>(2 * edge[0]) = field.value(b.points.col(edge[0]));
    const ProcessorWatch watch;
    const auto [u, read] = way.solve(b, load, held);
    r.seconds.push_back(watch.seconds());
    const gs::Norms norms = gs::field_norms(b, read, u, field);
    r.spacings.push_back(2.0 / cells), r.L2.push_back(norms.L2), r.H1.push_back(norms.H1);
  }
  return r;
}

/// Slope of a straight line through the logarithms.
double slope(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = Eigen::Index(x.size());
  const Eigen::ArrayXd a = Eigen::Map<const Eigen::ArrayXd>(x.data(), n).log(),
                       b = Eigen::Map<const Eigen::ArrayXd>(y.data(), n).log();
  return ((a - a.mean()) * (b - b.mean())).sum() / (a - a.mean()).square().sum();
}

void add_rates(PaperResults& results, double perturbation) {
  const std::string points = perturbation == 0 ? "regular points" : "moved points";
  const auto panel = [&](const std::string& t, const std::string& y) {
    return post::Panel{.t_title = t,
                       .y_title = fmt::format("{}, {}", y, points),
                       .series = {},
                       .t_scale = post::Scale::logarithmic,
                       .y_scale = post::Scale::logarithmic};
  };
  post::Panel L2 = panel("spacing [m]", "L2 error"), H1 = panel("spacing [m]", "H1 error"),
              cost = panel("processor time [s]", "L2 error");
  std::optional<Rates> elements;
  std::size_t number = 0;
  for (const auto& way : rate_ways()) {
    const Rates r = rates(way, perturbation);
    if (!elements) elements = r;  // the first way
    L2.series.push_back(numbered_series(way.name, number, {r.spacings, r.L2}));
    H1.series.push_back(numbered_series(way.name, number, {r.spacings, r.H1}));
    cost.series.push_back(numbered_series(way.name, number++, {r.seconds, r.L2}));
    const auto row = [&](const std::string& norm, const std::vector<double>& own,
                         const std::vector<double>& of_elements, double optimal) {
      const double order = slope(r.spacings, own);
      const bool reached = order > optimal - 0.1;
      const std::string item = fmt::format("7.2.3 manufactured field, {}, {}", points, way.name);
      PaperRow rate{.item = item,
                    .quantity = fmt::format("rate of the {} error, h = 1/4 to 1/32 m [-]", norm),
                    .ours = order,
                    .reference = slope(r.spacings, of_elements),
                    .reference_is = "bilinear elements on these points",
                    .processor_seconds = r.seconds.back()};
      rate.published = way.optimal ? std::optional(optimal) : std::nullopt;
      rate.claim = way.optimal ? Claim{fmt::format("rate {:g}", optimal), reached}
                               : Claim{fmt::format("rate {:g} is not reached", optimal), !reached};

      results.rows.push_back(rate);
      results.rows.push_back({.item = item,
                              .quantity = fmt::format("{} error at h = 1/32 m [{}]", norm, norm == "L2" ? "m^2" : "m"),
                              .ours = own.back(),
                              .reference = 0,
                              .reference_is = "the field itself",
                              .processor_seconds = r.seconds.back()});
    };
    if (number == 1) continue;  // elements, the reference
    row("L2", r.L2, elements->L2, 2);
    row("H1", r.H1, elements->H1, 1);
  }
  results.panels.insert(results.panels.end(), {L2, H1, cost});
}

// ----------------------------------------------------------------------------------------- 7.2.5 inf-sup values

void add_inf_sup(PaperResults& results, double perturbation) {
  const std::string points = perturbation == 0 ? "regular points" : "moved points";
  post::Panel panel{.t_title = "spacing / side",
                    .y_title = "inf-sup value, " + points,
                    .series = {},
                    .t_scale = post::Scale::logarithmic,
                    .y_scale = post::Scale::logarithmic};
  std::size_t number = 0;
  // names, and whether the value stays bounded by the thesis
  const std::vector<std::pair<const char*, bool>> all{{"U1", true},    {"Unl", false},   {"UnlP0", false},
                                                      {"U2P1", false}, {"U2P1C", false}, {"Unl+P1C", true}};
  for (const auto& [name, bounded] : all) {
    post::Curve curve;
    for (const int cells : {4, 8, 16}) {
      const ProcessorWatch watch;
      const auto value = gs::inf_sup(gs::basis(name), gs::Reach::circle, cells, perturbation).value;
      curve.t.push_back(1.0 / cells), curve.y.push_back(value);
      results.add(watch, fmt::format("7.2.5 inf-sup, {}, {}", points, name),
                  fmt::format("inf-sup value, {} x {} cells [-]", cells, cells), value);
    }
    const bool keeps = curve.y[2] > 0.06 && curve.y[2] > 0.7 * curve.y[1];

    results.rows.back().claim = Claim{bounded ? "bounded from below" : "not bounded", keeps == bounded};
    panel.series.push_back(numbered_series(name, number++, curve));
  }
  results.panels.push_back(panel);
}

// --------------------------------------------------------------------- 6.2, 7.1, 7.3.3: nearly incompressible

struct TightTask {
  std::string name;
  gs::Task task;
  bool loads_part;  // of an edge
};

/// A basis where nu is near 1/2, and what the thesis says of it; empty: nothing.
struct TightBasis {
  std::string name;
  std::optional<bool> locks, checkerboards;
};

const std::vector<TightBasis>& tight_bases() {
  static const std::vector<TightBasis> all{{"VC Unl", true, {}},
                                           {"VC U1SIG", {}, {}},
                                           {"PG-CA", {}, {}},
                                           {"PG-CA, residuals isochoric", {}, {}},
                                           {"CA, masters only", {}, {}},
                                           {"UnlP0", false, true},
                                           {"VC UnlP0", false, true},
                                           {"VC U2P1", true, {}},
                                           {"VC U2P1C", false, true},
                                           {"VC Unl+P1C", false, false}};
  return all;
}

void add_tight(PaperResults& results, const TightTask& tight) {
  const gs::Solid solid{1, 0.4999};
  const gs::Reference exact = gs::quadratic_elements(solid, tight.task, {48, 48});
  post::Panel panel{.t_title = "spacing / side",
                    .y_title = fmt::format("|error of u_y| [%], {}", tight.name),
                    .series = {},
                    .t_scale = post::Scale::logarithmic,
                    .y_scale = post::Scale::logarithmic};
  std::size_t number = 0;
  for (const auto& [name, locks, checkerboards] : tight_bases()) {
    if (tight.loads_part && name.find("U2") != std::string::npos) continue;  // its loads on a part are not defined

    post::Curve curve;
    for (const int cells : {4, 8, 16}) {
      const ProcessorWatch watch;
      const gs::Answer a = gs::answer(solid, gs::basis(name), tight.task, {cells, cells}, exact);
      const double error = std::abs(a.watched / exact.watched - 1);
      curve.t.push_back(1.0 / cells), curve.y.push_back(100 * error);
      if (cells != 16) continue;
      const std::string item = fmt::format("{}, nu = 0.4999, {}", tight.name, name);
      const std::string elements = "Q2/P-1 elements, 48 x 48";
      results.add(watch, item, "u_y at the corner [-]", a.watched, exact.watched, elements).claim =
          locks ? std::optional(Claim{*locks ? "locks" : "does not lock", (error > 0.15) == *locks}) : std::nullopt;
      results.add(watch, item, "rms error of the pressure / rms pressure [-]", a.pressure_error, 0, elements);
      results.add(watch, item, "checkerboard of the pressure / rms pressure [-]", a.checkerboard, 0, elements).claim =
          checkerboards ? std::optional(Claim{*checkerboards ? "checkerboards" : "no checkerboards",
                                              (a.checkerboard > 0.07) == *checkerboards})
                        : std::nullopt;
    }
    panel.series.push_back(numbered_series(name, number++, curve));
  }
  results.panels.push_back(panel);
}

// ------------------------------------------------------------------------------- 7.3.8 coupling with elements

gs::Sparse stiffness_of(const gs::Solid& solid, const std::string& name, const gs::Body& b) {
  return gs::condensed(solid, gs::blocks(solid, b, gs::basis(name)));
}

void add_cantilever(PaperResults& results) {
  const gs::Solid solid{1000, 0.3};
  const gs::Task task = gs::cantilever();
  const gs::Reference exact = gs::quadratic_elements(solid, task, {64, 16});
  for (const char* name : {"PG-CA", "VC Unl", "VC Unl+P1C"})
    for (const bool coupled : {true, false}) {
      const ProcessorWatch watch;
      const gs::Placed points = gs::placed(task, {32, 8}, gs::basis(name).reach);
      const auto own = [&](const gs::Body& b) { return stiffness_of(solid, name, b); };
      const auto K = coupled ? gs::coupled(
                                   solid, points.body, [](const auto& x) { return x.x() < 4; }, own)
                             : own(points.body);
      const Eigen::VectorXd u = gs::solved(K, gs::loads(task, points), gs::supports(task, points));
      results.add(watch, fmt::format("7.3.8 cantilever, {}{}", name, coupled ? " beside elements" : ""),
                  "u_y at the tip [-]", u[u.size() - 1], exact.watched, "Q2/P-1 elements, 64 x 16");
    }
}

/// A formulation beside elements around the hole: stiffness of its part, and the gradients that are read there.
struct HoleWay {
  std::string name;
  std::function<gs::Sparse(const gs::Body&)> stiffness;
  std::function<gs::System(const gs::Body&)> read;
  bool consistent;
};

std::vector<HoleWay> hole_ways() {
  std::vector<HoleWay> all;
  for (const char* name : {"VC Unl", "PG-CA", "Unl"})
    all.push_back({name, [name](const gs::Body& b) { return stiffness_of(thesis_solid, name, b); },
                   gs::basis(name).system, std::string(name) != "Unl"});
  for (const bool corrected : {true, false})
    all.push_back({corrected ? "VCPPG V3 Unl" : "PPG Unl",
                   [corrected](const gs::Body& b) {
                     const gs::System u1 = gs::linear_static(b);
                     return gs::petrov_stiffness(gs::law(thesis_solid), b, gs::moving(b),
                                                 corrected ? gs::variationally_consistent(b, u1) : u1,
                                                 gs::Petrov::first);
                   },
                   [](const gs::Body& b) { return gs::moving(b); }, corrected});
  return all;
}

/// sigma_xx by the closed form and by points on the line x = 0 above the hole, in families and in elements.
struct HoleLine {
  post::Curve exact, ours;
  double concentration, mean, worst;  // at the hole; rms and largest error over the line
};

HoleLine line_above(const gs::Placed& points, const Eigen::VectorXd& u, const HoleWay& way) {
  HoleLine line{{}, {}, 0, 0, 0};
  for (const bool families : {true, false}) {
    const gs::Part part = gs::part(points.body, [=](const auto& x) { return gs::beyond_hole(x) != families; });
    const gs::System read = families ? way.read(part.body) : gs::central_average(part.body);
    for (std::size_t k = 0; k < part.names.size(); ++k) {
      const Eigen::Vector2d x = part.body.points.col(Eigen::Index(k));
      if (points.places(1, part.names[k]) < 1) continue;
      Eigen::Matrix2d H = Eigen::Matrix2d::Zero();
      for (std::size_t i = 0; i < read[k].nodes.size(); ++i)
        H += u.segment<2>(2 * part.names[std::size_t(read[k].nodes[i])]) *
             read[k].samples[0].gradient.col(Eigen::Index(i)).transpose();
      const double own = thesis_solid.stress(H)(0, 0), exact = gs::hole_stress(x)(0, 0);
      if (line.ours.t.empty()) line.concentration = own;
      line.exact.t.push_back(x.y()), line.exact.y.push_back(exact);
      line.ours.t.push_back(x.y()), line.ours.y.push_back(own);
      line.mean += (own - exact) * (own - exact), line.worst = std::max(line.worst, std::abs(own - exact));
    }
  }
  line.mean = std::sqrt(line.mean / double(line.ours.t.size()));
  return line;
}

constexpr int hole_cells = 48;  // along each side

void add_hole(PaperResults& results) {
  const gs::Task task = gs::plate_with_hole();
  const gs::Placed points = gs::placed(task, {hole_cells, hole_cells}, gs::Reach::cells);
  post::Panel panel{"y / radius, at x = 0", "sigma_xx / tension", {}};
  std::size_t number = 0;
  for (const auto& way : hole_ways()) {
    const ProcessorWatch watch;
    const auto K = gs::coupled(thesis_solid, points.body, gs::beyond_hole, way.stiffness);
    const Eigen::VectorXd u = gs::solved_by_lu(K, gs::loads(task, points), gs::supports(task, points));
    const HoleLine line = line_above(points, u, way);
    if (number == 0)
      panel.series.push_back({.label = "closed form", .line = post::Line::reference, .curve = line.exact});
    panel.series.push_back(numbered_series(way.name, number++, line.ours));
    const std::string item = fmt::format("7.3.8 plate with hole, {} beside elements", way.name);
    const std::string infinite = "closed form of the infinite plate";
    const Eigen::Index top = points.places.cols() - 1 - hole_cells;  // at (0, 1)
    results.add(watch, item, "sigma_xx / tension at the hole [-]", line.concentration, 3, infinite);
    results.add(watch, item, "rms error of sigma_xx / tension at x = 0 [-]", line.mean, 0, infinite).claim =
        way.consistent ? Claim{"agrees very well", line.mean < 0.05}
                       : Claim{"strong oscillations near coupling and boundary", line.mean > 0.2};
    results.add(watch, item, "largest error of sigma_xx / tension at x = 0 [-]", line.worst, 0, infinite);
    results.add(watch, item, "u_y E / (tension radius) at the hole [-]", u[2 * top + 1] * thesis_solid.young,
                gs::hole_displacement(thesis_solid, points.body.points.col(top)).y() * thesis_solid.young, infinite);
  }
  results.panels.push_back(panel);
}

}  // namespace

PaperResults bode(const std::filesystem::path&) {
  PaperResults results;
  add_patches(results);
  add_modes(results);
  for (const double perturbation : {0.0, moved_by}) add_rates(results, perturbation);
  for (const double perturbation : {0.0, moved_by}) add_inf_sup(results, perturbation);
  add_tight(results, {"7.1 Cook's panel", gs::cook(), false});
  add_tight(results, {"7.3.3 punched block", gs::punched_block(), true});
  add_cantilever(results);
  add_hole(results);
  return results;
}

}  // namespace cases
