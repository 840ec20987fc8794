#include "post/factors/tip_methods.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <variant>

#include "plate/model/space.hpp"
#include "post/factors/displacement_extrapolation.hpp"
#include "post/factors/errors.hpp"
#include "post/factors/interaction.hpp"
#include "post/factors/series_fit.hpp"
#include "post/factors/tip_integrals.hpp"
#include "post/factors/tip_place.hpp"

namespace post {
namespace {

/// Share of the second and third mode in the energy above which a tip counts as one of mixed mode.
constexpr double mixed_mode = 0.02;

ErrorShares shares_of(const TipView& plate, const TipPlace& place, const plate::Section& section) {
  const auto& trust = plate.trust;
  // an error of the first order, the larger the fewer points lie between a tip and what is next to it; of other tips
  // half as much
  const double least = plate.spacing / 2;
  const double near =
      plate.spacing * std::max(1 / std::max(place.clear, least), 0.5 / std::max(place.narrowest, least));
  return {.energy = trust.energy,
          .shear = trust.shear,
          .fits = trust.fits,
          .fits_shear = trust.fits_shear,
          .least = std::max(6e-4, trust.near * near) + place.known_error,
          .layer = trust.layer,
          .width = trust.width / section.layer(),
          .doubt = trust.doubt,
          .faces = plate.points_on_faces ? place.faces / section.layer() : 0,
          .lost = trust.lost,
          .mixing = section.isotropic() ? 0 : interaction_error * plate.spacing / section.thickness,
          .own_shear = trust.own_shear,
          .tied = place.tied ? 1.0 : 0.0,
          .sliding = trust.near_sliding * near};
}

/// Angle by which a staircase of points turns the field that a fit within `reach` sees: at most the angle between the
/// crack and its steps, which are parallel or diagonal to the lattice; 0 where it has a whole step [rad].
double turn_of_stairs(const geometry::Point& ahead, double spacing, double reach) {
  constexpr double diagonal = std::numbers::pi / 4;
  const double angle = std::abs(std::remainder(std::atan2(ahead.y(), ahead.x()), diagonal));
  return std::tan(angle) < spacing / reach ? angle : 0;
}

/// The axes of a tip: of a straight crack half way between the points on either side of it.
TipFrame placed(const TipPlace& place, const TipView& plate) {
  return place.frame.curve.empty() ? TipFrame(centred(place.tip, plate)) : place.frame;
}

/// Largest outer radius of the rings that fit [length].
double largest_radius(double clear, double spacing, bool graded) {
  double result = 0;
  for (const auto& ring : rings(clear, spacing, graded)) result = std::max(result, ring.outer);
  return result;
}

}  // namespace

/// The methods with all that they know of their tip.
class TipMethods::AtTip {
public:
  AtTip(std::shared_ptr<const TipView> view, const TipPlace& place, const SrifOptions& options);

  std::vector<Srif> operator()(const plate::State& state, const plate::Forces& force, bool all_rings,
                               const ActingAtTip& acting) const;
  const std::vector<std::string>& left_out() const { return left_out_; }
  bool works() const { return left_out_.size() < methods_.size(); }
  Eigen::MatrixXd functionals() const;
  bool needs_force() const { return !integrals_.empty(); }

private:
  struct Integral {
    SrifMethod method;
    std::vector<Ring> rings;
    std::vector<TipIntegral> integrals;  // one per ring
  };

  /// Adds a method. Returns the reason why it cannot work at this tip, empty where it can.
  std::string add(SrifMethod method, const std::vector<geometry::Point>& positions, const TipPlace& place,
                  const SrifOptions& options);
  std::string add_opening(std::vector<DisplacementExtrapolation>& openings,
                          const std::vector<geometry::Point>& positions, const TipPlace& place, const OpeningFit& how);
  std::string add_integral(SrifMethod method, double clear, bool first_ring_only);
  /// `heat`: what heat that varies adds to G of a ring.
  Srif of(const Integral& integral, std::size_t rings, const Eigen::Vector3d& mix, const NearField& field,
          const Eigen::VectorXd& forward_work, const std::function<double(const Ring&)>& heat) const;
  std::size_t rings_of(const Integral& integral, bool all) const;
  Srif by_fit(const std::vector<FitSrif>& fits) const;
  void fit(const TipFrame& frame, const TipPlace& place, bool first_only);
  PlateScale scale() const { return {at_.section, view_->spacing, view_->horizon, view_->points_on_faces}; }
  std::vector<FitSrif> fitted(const NearField& field) const;
  /// Interaction integrals of a plate in its plane whose deflections stretch it: its fields are no free ones.
  std::vector<FitSrif> interactions(const NearField& field, const FreeCurvatures& free) const;
  /// K1, K2, K3 of the first fit; K3 is zero where a shear layer holds both faces together.
  Eigen::Vector3d of_first(const std::vector<FitSrif>& fits) const;
  Eigen::Vector3d split(const std::vector<FitSrif>& fits, const plate::State& state) const;

  std::shared_ptr<const TipView> view_;
  geometry::Tip tip_;
  TipSection at_;
  ErrorShares shares_;
  std::vector<SrifMethod> methods_;
  std::vector<std::string> left_out_;
  TipSurroundings surroundings_;
  std::vector<Integral> integrals_;
  std::vector<SeriesFit> fits_;  // the best first; none where the field within a thickness is not resolved
  std::string no_fit_;           // why
  std::vector<DisplacementExtrapolation> openings_;
  std::vector<DisplacementExtrapolation> mix_;  // one, where it is not: proportions from the opening
};

TipMethods::AtTip::AtTip(std::shared_ptr<const TipView> view, const TipPlace& place, const SrifOptions& options)
    : view_(std::move(view)),
      tip_(place.tip),
      at_(view_->section.at(place.tip.position), place.tip.direction),
      shares_(shares_of(*view_, place, at_.section)),
      methods_(options.methods),
      surroundings_(*view_, placed(place, *view_), largest_radius(place.clear, view_->spacing, view_->graded)) {
  const TipView& plate = *view_;
  if (!std::ranges::all_of(methods_, of_opening)) fit(surroundings_.frame(), place, options.first_ring_only);
  const std::vector<geometry::Point> positions(plate.positions.begin(),
                                               plate.positions.begin() + std::ptrdiff_t(plate.plate_points));
  for (const auto method : methods_)
    if (auto reason = add(method, positions, place, options); !reason.empty()) left_out_.push_back(std::move(reason));
  if (!fits_.empty() || integrals_.empty()) return;
  if (const auto reason = add_opening(mix_, positions, place, narrow_fit(scale())); !reason.empty()) {
    for (const auto& integral : integrals_)
      left_out_.push_back(fmt::format("{}: no mode mix: {}", name_of(integral.method), reason));
    integrals_.clear();
  }
}

std::string TipMethods::AtTip::add(SrifMethod method, const std::vector<geometry::Point>& positions,
                                   const TipPlace& place, const SrifOptions& options) {
  if (method == SrifMethod::series_fit) return no_fit_;
  if (method == SrifMethod::opening_series) return add_opening(openings_, positions, place, series_fit(scale()));
  if (of_opening(method)) return add_opening(openings_, positions, place, paper_fit(scale(), options));
  return add_integral(method, place.clear, options.first_ring_only);
}

std::string TipMethods::AtTip::add_opening(std::vector<DisplacementExtrapolation>& openings,
                                           const std::vector<geometry::Point>& positions, const TipPlace& place,
                                           const OpeningFit& how) {
  auto found = DisplacementExtrapolation::at(positions, place.path, place.tip, scale(), how);
  if (auto* reason = std::get_if<std::string>(&found)) return std::move(*reason);
  openings.push_back(std::get<DisplacementExtrapolation>(std::move(found)));
  return "";
}

std::string TipMethods::AtTip::add_integral(SrifMethod method, double clear, bool first_ring_only) {
  const TipView& plate = *view_;
  const TipFrame& frame = surroundings_.frame();
  Integral result{method, rings(clear, plate.spacing, plate.graded), {}};
  if (first_ring_only && !result.rings.empty()) result.rings.erase(result.rings.begin() + 1, result.rings.end());
  if (result.rings.empty())
    return fmt::format("{}: no ring of 4 spacings fits into {:.1f} spacings of room; set {} = {:.2g}", name_of(method),
                       clear / plate.spacing, plate.points_on_faces ? "`tip_spacing`" : "`spacing`", clear / 5);
  for (const auto& ring : result.rings)
    result.integrals.emplace_back(surroundings_, ring,
                                  method == SrifMethod::virtual_crack_extension ? plate.virtual_extension(frame, ring)
                                                                                : domain_integral(plate, frame, ring));
  integrals_.push_back(std::move(result));
  return "";
}

/// Fits over the widest range that serves, and over parts of it for the estimate of the error.
void TipMethods::AtTip::fit(const TipFrame& frame, const TipPlace& place, bool first_only) {
  // the fields of a force are singular: their series converges slowly towards it
  double clear = std::min(place.clear, place.undisturbed / 2);
  const TipView& plate = *view_;
  // the fields have the first order of a curvature: where points suffice, fewer of the others are seen
  if (plate.graded && !frame.curve.empty()) clear = std::max(clear / 2, std::min(clear, 30 * plate.spacing));
  if (!at_.section.isotropic()) {
    no_fit_ = "series_fit: all fields about a tip are known for isotropic sections alone";
    auto around = rings(place.clear, plate.spacing, plate.graded);
    if (first_only && !around.empty()) around.resize(1);
    fits_ = interaction_integrals(plate, frame, at_, around);
    return;
  }
  const auto range = fit_range(at_.section, clear, plate.spacing, plate.graded);
  if (!range) {
    no_fit_ = fmt::format(
        "series_fit: no range of 4 spacings fits into {:.1f} spacings and 2 thicknesses; set {} "
        "= {:.2g}",
        clear / plate.spacing, plate.points_on_faces ? "`tip_spacing`" : "`spacing`",
        std::min(0.22 * clear, 1.7 * at_.section.layer()));
    return;
  }
  const bool heated = place.heated && plate.points_on_faces;  // with bonds two more fields cost more than they give
  fits_ = series_fits(plate, frame, *range, first_only ? std::vector{1.0} : std::vector{1.0, 0.65, 0.5}, heated);
  shares_.turn = plate.trust.stairs * turn_of_stairs(frame.ahead, plate.spacing, range->outer);
  if (fits_.empty()) no_fit_ = "series_fit: too few points about the tip for a fit of its fields; refine";
}

std::vector<FitSrif> TipMethods::AtTip::fitted(const NearField& field) const {
  std::vector<FitSrif> result;
  for (const auto& fit : fits_) {
    const Eigen::Vector3d K = fit(field);
    result.push_back({fit.range.inner, fit.range.outer, K[0], K[1], K[2]});
  }
  return result;
}

std::vector<FitSrif> TipMethods::AtTip::interactions(const NearField& field, const FreeCurvatures& free) const {
  std::vector<FitSrif> result;
  if (integrals_.empty()) return result;
  const auto& around = integrals_.front().rings;
  TipFrame frame = surroundings_.frame();
  if (frame.curve.empty()) frame = TipFrame(tip_);
  const auto all = interaction_integrals(*view_, frame, at_, around);
  for (std::size_t i = 0; i < around.size(); ++i) {
    const Eigen::Vector3d K = all[i](field) + interaction_of_free_curvatures(*view_, frame, at_, around[i], free);
    result.push_back({around[i].inner, around[i].outer, K[0], K[1], K[2]});
  }
  return result;
}

Eigen::MatrixXd TipMethods::AtTip::functionals() const {
  if (fits_.empty()) return {};
  const SeriesFit& fit = fits_.front();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(3, plate::unknowns_per_point * Eigen::Index(view_->positions.size()));
  for (std::size_t i = 0; i < fit.points.size(); ++i)
    result.middleCols(plate::index_by_points(Eigen::Index(fit.points[i]), 0), plate::unknowns_per_point) =
        fit.row.middleCols(plate::index_by_points(Eigen::Index(i), 0), plate::unknowns_per_point);
  result.row(2) *= at_.section.thickness;
  return result;
}

/// K1, K2, K3 whose signs and proportions the integrals of the energy release rate take over.
Eigen::Vector3d TipMethods::AtTip::split(const std::vector<FitSrif>& fits, const plate::State& state) const {
  if (!fits.empty()) return of_first(fits);
  if (mix_.empty()) return Eigen::Vector3d::Zero();
  const Srif opening = mix_.front()(state);
  return {opening.K1, opening.K2, shares_.tied > 0 ? 0 : opening.K3};
}

Eigen::Vector3d TipMethods::AtTip::of_first(const std::vector<FitSrif>& fits) const {
  const FitSrif& first = fits.front();
  return {first.K1, first.K2, shares_.tied > 0 ? 0 : first.K3};
}

/// The first ring gives the result; its error comes from the other methods, or from the second ring.
std::size_t TipMethods::AtTip::rings_of(const Integral& integral, bool all) const {
  const std::size_t count = integral.rings.size();
  return all ? count : std::min<std::size_t>(count, integrals_.size() > 1 ? 1 : 2);
}

Srif TipMethods::AtTip::of(const Integral& integral, std::size_t rings, const Eigen::Vector3d& mix,
                           const NearField& field, const Eigen::VectorXd& forward_work,
                           const std::function<double(const Ring&)>& heat) const {
  Srif result;
  result.position = tip_.position;
  result.method = integral.method;
  result.samples = rings;
  for (std::size_t i = 0; i < rings; ++i) {
    const double G = integral.integrals[i](field, forward_work) + (heat ? heat(integral.rings[i]) : 0);
    const auto K = factors(G, mix, at_);
    result.rings.push_back({integral.rings[i].inner, integral.rings[i].outer, G, K[0], K[1], K[2]});
  }
  const RingSrif& first = result.rings.front();
  result.G = first.G, result.K1 = first.K1, result.K2 = first.K2, result.K3 = first.K3;
  return result;
}

Srif TipMethods::AtTip::by_fit(const std::vector<FitSrif>& fits) const {
  Srif result;
  result.position = tip_.position;
  result.method = SrifMethod::series_fit;
  result.samples = fits_.front().points.size();
  result.fits = fits;
  const Eigen::Vector3d K = of_first(fits);
  result.K1 = K[0], result.K2 = K[1], result.K3 = K[2];
  return result;
}

std::vector<Srif> TipMethods::AtTip::operator()(const plate::State& state, const plate::Forces& force, bool all_rings,
                                                const ActingAtTip& acting) const {
  const auto& [free, on_faces] = acting;
  const NearField field(state, view_->positions, surroundings_.centre());
  const bool stretched = free && at_.section.law == plate::PlateLaw::membrane;
  const std::vector<FitSrif> fits = stretched ? interactions(field, *free) : fitted(field);
  const Eigen::Vector3d mix = split(fits, state);
  double radius = 0;
  for (const auto& integral : integrals_)
    for (std::size_t i = 0; i < rings_of(integral, all_rings); ++i) radius = std::max(radius, integral.rings[i].outer);
  Eigen::VectorXd work = integrals_.empty() ? Eigen::VectorXd() : surroundings_.forward_work(state, force, radius);
  for (Eigen::Index i = 0; on_faces && i < work.size(); ++i)
    work[i] += (*on_faces)[surroundings_.points()[std::size_t(i)]];
  std::function<double(const Ring&)> heat;
  if (free)
    heat = [&](const Ring& ring) {
      return release_of_free_curvatures(*view_, surroundings_.frame(), ring, state, field, *free);
    };
  std::vector<Srif> found;
  for (const auto method : methods_) {
    for (const auto& integral : integrals_)
      if (integral.method == method)
        found.push_back(of(integral, rings_of(integral, all_rings), mix, field, work, heat));
    if (method == SrifMethod::series_fit && no_fit_.empty() && !stretched) found.push_back(by_fit(fits));
    for (const auto& opening : openings_)
      if (auto srif = opening(state); srif.method == method) {
        found.push_back(std::move(srif));
        break;
      }
  }
  estimate_errors(found, fits, at_, shares_);
  // interaction integrals have the fields of a straight crack
  const double curvature = std::abs(surroundings_.frame().curvature), thickness = at_.section.thickness;
  for (auto& srif : found)
    if (stretched && curvature > 0) widen(srif, curvature * radius / 4 * largest_factor(srif, thickness), thickness);
  // openings were asked for beside methods that vouch for them, and these have no room: errors of 20 % were found where
  // 7 % were estimated
  if (integrals_.empty() && fits_.empty() && !std::ranges::all_of(methods_, of_opening))
    for (auto& srif : found) srif.resolved.fill(false);
  // the faces are loaded in the second and third mode: there the domain integral is better, where the field within a
  // thickness is resolved
  const Eigen::Vector3d energy = at_.unit_release().cwiseProduct(mix.cwiseAbs2());
  const bool sheared = energy[1] + energy[2] > mixed_mode * energy.sum();
  const SrifMethod first = (sheared && !fits_.empty()) || view_->trust.domain_integral
                               ? SrifMethod::domain_integral
                               : SrifMethod::virtual_crack_extension;
  std::ranges::stable_partition(found, [&](const Srif& srif) { return srif.method == first; });
  std::ranges::stable_partition(
      found, [](const Srif& srif) { return srif.resolved[0] || srif.resolved[1] || srif.resolved[2]; });
  return found;
}

TipMethods::TipMethods(std::shared_ptr<const TipView> view, const TipPlace& place, const SrifOptions& options)
    : at_tip_(std::make_unique<AtTip>(std::move(view), place, options)) {}

TipMethods::TipMethods(bool works, std::vector<std::string> left_out)
    : works_elsewhere_(works), left_out_elsewhere_(std::move(left_out)) {}

TipMethods::TipMethods(TipMethods&&) noexcept = default;
TipMethods& TipMethods::operator=(TipMethods&&) noexcept = default;
TipMethods::~TipMethods() = default;

std::vector<Srif> TipMethods::operator()(const plate::State& state, const plate::Forces& force, bool all_rings,
                                         const ActingAtTip& acting) const {
  return (*at_tip_)(state, force, all_rings, acting);
}

const std::vector<std::string>& TipMethods::left_out() const {
  return here() ? at_tip_->left_out() : left_out_elsewhere_;
}

bool TipMethods::works() const {
  return here() ? at_tip_->works() : works_elsewhere_;
}

Eigen::MatrixXd TipMethods::functionals() const {
  return at_tip_->functionals();
}

bool TipMethods::needs_force() const {
  return here() && at_tip_->needs_force();
}

}  // namespace post
