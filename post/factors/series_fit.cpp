#include "post/factors/series_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <initializer_list>
#include <optional>

#include "plate/model/space.hpp"

namespace post {
namespace {

/// cos and sin of n pi / 2, exactly.
double cosine(int n) {
  return n % 2 ? 0 : n % 4 ? -1 : 1;
}
double sine(int n) {
  return cosine(n - 1);
}

/// sum c_a z^(a/2) conj(z)^(b/2) with a + b = `degree`, of an odd field i times that; a, b >= -3. Terms that are 0 are
/// none.
class Powers {
public:
  explicit Powers(int degree) : degree_(degree), factors_(std::size_t(degree + 2 * beyond + 1)) {}
  Powers(int degree, std::initializer_list<std::pair<int, double>> terms) : Powers(degree) {
    for (const auto& [a, c] : terms) at(a) += c;
  }

  int degree() const { return degree_; }
  double& at(int a) { return factors_[std::size_t(a + beyond)]; }
  double at(int a) const { return factors_[std::size_t(a + beyond)]; }

  /// visit(a, b, c) in ascending a.
  template <typename Visit>
  void for_each(const Visit& visit) const {
    for (int a = -3; a <= degree_ + 3; ++a)
      if (const double c = at(a); c != 0) visit(a, degree_ - a, c);
  }

private:
  static constexpr int beyond = 5;  // a that are asked for, or set to 0
  int degree_;
  std::vector<double> factors_;
};

/// `sum` and `other` of one degree.
void add(Powers& sum, const Powers& other, double factor = 1) {
  other.for_each([&](int a, int, double c) { sum.at(a) += factor * c; });
}

/// Derivatives by z and by conj(z), as if these were independent.
Powers d_dz(const Powers& f) {
  Powers result(f.degree() - 2);
  f.for_each([&](int a, int, double c) {
    if (a != 0) result.at(a - 2) = c * a / 2;
  });
  return result;
}

Powers d_dconj(const Powers& f) {
  Powers result(f.degree() - 2);
  f.for_each([&](int a, int b, double c) {
    if (b != 0) result.at(a) = c * b / 2;
  });
  return result;
}

}  // namespace

/// Makes the series power by power (lengths in `radius`, D = 1). With Psi = psi_x + i psi_y and s = S radius^2 / D:
/// 4 w_zz* = Psi_z + conj(...), 2 (1 - nu) Psi_zz* + (1 + nu) (Psi_z + conj(...))_z* = s (Psi - 2 w_z*).
class TipSeries::Maker {
public:
  Maker(double poisson, double s, double curvature) : nu_(poisson), s_(s), curvature_(curvature) {}

  std::vector<Field> fields(int order, bool heated) {
    std::vector<Field> result;
    const auto take = [&](Field field) {
      if (curvature_ != 0) bend(field);
      result.push_back(std::move(field));
    };
    for (const bool even : {true, false}) {
      const auto begin = [&] { sign_ = even ? 1 : -1; };
      for (int n = 0; n <= order; ++n) begin(), take(series(eigenfunction(n), {}, n, n));
      if (s_ == 0) continue;  // nothing couples psi to w
      for (int p = even ? 0 : 1; p <= order + 2; ++p)
        if (p % 2 == (even ? 0 : 1)) begin(), take(series(harmonic(p), p - 2));
      begin();
      if (even) take(series(Powers(4, {{2, 0.25}}), 2));  // w = r^2 / 4: an even load
      begin();
      // psi = z^2 / 2 has the curvature kappa_0 = x' and no moments, i psi that of -y'
      if (heated) result.push_back(series(Powers(4, {{4, 0.5}}), {}, 4, 4));
    }
    return result;
  }

  /// M_yy / M_xy / Q_y / S straight ahead of the leading term r^(1/2) of the field, without their r^(-1/2).
  Eigen::Vector3d ahead(const Field& field) {
    sign_ = field.even ? 1 : -1;
    const auto leading = [](const std::vector<Term>& terms) {
      Powers result(1);
      for (const auto& term : terms)
        if (term.twice_p == 1) result.at((1 + term.twice_q) / 2) = term.c;
      return result;
    };
    const auto moments = moments_at(leading(field.psi), 0);
    return {moments[0], moments[1], slope_across(leading(field.w), 0)};
  }

private:
  /// Real and imaginary part of f at r = 1, angle n pi.
  std::array<double, 2> at(const Powers& f, int n) const {
    double x = 0, y = 0;
    f.for_each([&](int a, int b, double c) { x += c * cosine(n * (a - b)), y += c * sine(n * (a - b)); });
    return sign_ > 0 ? std::array{x, y} : std::array{-y, x};
  }

  /// M_yy, M_xy at r = 1, angle n pi, but for the sign.
  Eigen::Vector2d moments_at(const Powers& psi, int n) const {
    const double divergence = 2 * at(d_dz(psi), n)[0];
    const auto shear = at(d_dconj(psi), n);
    return {(1 + nu_) / 2 * divergence - (1 - nu_) * shear[0], (1 - nu_) * shear[1]};
  }

  double slope_across(const Powers& w, int n) const { return -2 * at(d_dz(w), n)[1]; }

  /// Both solutions of the plane-stress equations of degree n/2, by their factors of z^n/2 and conj(z)^n/2.
  std::vector<Powers> plane(int n) const {
    if (n == 0) return {Powers(0, {{0, 1.0}})};
    return {Powers(n, {{n, 1.0}, {2, -sign_ * (1 + nu_) / (3 - nu_) * n / 2}}), Powers(n, {{0, 1.0}})};
  }

  Eigen::Matrix2Xd face_moments(const std::vector<Powers>& fields) const {
    Eigen::Matrix2Xd result(2, Eigen::Index(fields.size()));
    for (std::size_t i = 0; i < fields.size(); ++i) result.col(Eigen::Index(i)) = moments_at(fields[i], 1);
    return result;
  }

  /// The combination of both whose faces are free.
  Powers eigenfunction(int n) const {
    const auto both = plane(n);
    if (n == 0) return both.front();
    const Eigen::Matrix2Xd faces = face_moments(both);
    const Eigen::Index row = faces.row(0).norm() > faces.row(1).norm() ? 0 : 1;  // the other vanishes by itself
    const Eigen::Vector2d free = Eigen::Vector2d(-faces(row, 1), faces(row, 0)).normalized();
    Powers result(n);
    for (std::size_t i = 0; i < 2; ++i) add(result, both[i], free[Eigen::Index(i)]);
    return result;
  }

  /// r^(p/2) cos or sin of p angle / 2.
  Powers harmonic(int p) const {
    if (p == 0) return Powers(0, {{0, 1.0}});
    return Powers(p, {{p, 0.5}, {0, sign_ * 0.5}});
  }

  /// w of degree n/2 + 1 with lap w = div psi, psi of degree n/2, and w,y - psi_y = `slip` on the upper face.
  Powers deflection(const Powers& psi, int n, double slip = 0) const {
    Powers w(n + 2);
    d_dz(psi).for_each([&](int a, int b, double c) {
      const double part = c / ((a + 2) * (b + 2));  // of 4 (a/2 + 1) (b/2 + 1)
      w.at(a + 2) += part;
      w.at(b + 2) += sign_ * part;
    });
    const auto own = harmonic(n + 2);
    const double reached = slope_across(own, 1);
    if (reached != 0) add(w, own, (at(psi, 1)[1] - slope_across(w, 1) + slip) / reached);
    return w;
  }

  /// psi of degree n/2 + 2 that answers psi of degree n/2, if any, and w of degree n/2 + 1, with free faces but for the
  /// moment M_xy on the upper one.
  Powers rotation(const std::optional<Powers>& psi, const Powers& w, int n, double twist = 0) const {
    Powers source(n), result(n + 4);
    if (psi) add(source, *psi, s_);
    add(source, d_dconj(w), -2 * s_);
    Powers pending = source;
    source.for_each([&](int a, int b, double c) {
      if (pending.at(a) == 0) return;
      const int partner = b + 2;
      solve_pair(a, b, c, source.at(partner), result);
      pending.at(partner) = 0;
    });
    const auto own = plane(n + 4);
    const Eigen::Matrix2Xd faces = face_moments(own);
    const Eigen::Index row = faces.row(0).norm() > faces.row(1).norm() ? 0 : 1;
    const double missing = (row == 1 ? twist : 0) - moments_at(result, 1)[row], square = faces.row(row).squaredNorm();
    for (std::size_t i = 0; i < own.size(); ++i) add(result, own[i], missing * faces(row, Eigen::Index(i)) / square);
    return result;
  }

  /// The factors X of z^(a+1) conj(z)^(b+1) and Y of z^(b+2) conj(z)^a, which the terms z^a conj(z)^b and
  /// z^(b+1) conj(z)^(a-1) of the equation have in common.
  void solve_pair(int twice_a, int twice_b, double first, double second, Powers& result) const {
    const double a = twice_a / 2.0, b = twice_b / 2.0;
    const double own = 3 - nu_, crossed = sign_ * (1 + nu_);
    double X = 0, Y = 0;
    if (b + 1 == 0) {
      Y = a == 0 ? 0 : second / (own * (b + 2) * a);
    } else if (a == 0) {
      X = first / (own * (a + 1) * (b + 1));
    } else {
      const double sum = first / (b + 1),
                   partner = second / a;  // own (a+1) X + crossed (b+2) Y, and the other way round
      const double determinant = own * own - crossed * crossed;
      X = (own * sum - crossed * partner) / determinant / (a + 1);
      Y = (own * partner - crossed * sum) / determinant / (b + 2);
    }
    result.at(twice_a + 2) = X;
    if (twice_a != twice_b + 2) result.at(twice_b + 4) = Y;
  }

  /// The terms of one degree of a sum.
  static Powers of_degree(const std::vector<Term>& terms, int degree) {
    Powers result(degree);
    for (const auto& term : terms)
      if (term.twice_p == degree) result.at((degree + term.twice_q) / 2) = term.c;
    return result;
  }

  /// Forces that a field of free faces on the line leaves on those of a curve y = curvature x^2 / 2, to the first
  /// order: M_xy and w,y - psi_y at r = 1 on the upper face, of degrees m and m + 1 for psi of degree m = n/2; and M_xy
  /// by the shear, of degree m + 2.
  struct Left {
    double twist, slip, twist_of_shear;
  };
  Left left_on_curve(const Field& field, int n) const {
    const auto psi = of_degree(field.psi, n), w = of_degree(field.w, n + 2);
    const double m = n / 2.0, divergence = 2 * at(d_dz(psi), 1)[0], half = curvature_ / 2;
    const double along = (1 + nu_) / 2 * divergence + (1 - nu_) * at(d_dconj(psi), 1)[0];  // M_xx
    const double shear = 2 * at(d_dz(w), 1)[0] - at(psi, 1)[0];                            // w,x - psi_x
    const double load = 4 * at(d_dconj(d_dz(w)), 1)[0] - divergence;                       // lap w - div psi
    return {-half * (m + 1) * along, -half * ((m + 2) * shear + load), half * s_ * shear};
  }

  /// Adds the terms of the other symmetry by which the faces are free on the curve too, to the first order of its
  /// curvature.
  void bend(Field& field) {
    int first = 1000, last = 0;
    for (const auto& term : field.psi) first = std::min(first, term.twice_p), last = std::max(last, term.twice_p);
    for (const auto& term : field.w) first = std::min(first, term.twice_p - 2);
    std::optional<Powers> psi;
    Powers w(first);
    double twist_of_shear = 0;
    for (int n = first; n <= last; n += 4) {  // psi is of the degree n + 2 here, and w of n + 4
      sign_ = field.even ? 1 : -1;
      const auto left = left_on_curve(field, n);
      sign_ = -sign_;
      const auto next = n < 0 ? Powers(n + 2) : rotation(psi, w, n - 2, left.twist + twist_of_shear);
      const auto deflected = deflection(next, n + 2, left.slip);
      append(field.psi_of_curve, next);
      if (s_ != 0) append(field.w_of_curve, deflected), w = deflected, psi = next;
      twist_of_shear = left.twist_of_shear;
    }
  }

  /// The series that begins with w of degree n/2 + 1.
  Field series(const Powers& w, int n) const { return series(rotation({}, w, n), w, n + 4, n); }

  /// The series that begins with psi of degree n/2, and may have had a w before that.
  Field series(Powers psi, const std::optional<Powers>& first, int n, int order) const {
    constexpr int most = 40;  // of steps; 6 to 12 are taken
    constexpr double negligible = 1e-9;
    Field result{sign_ > 0, order, {}, {}};
    if (first) append(result.w, *first);
    append(result.psi, psi);
    if (s_ == 0) return result;
    for (int step = 0; step < most; ++step, n += 4) {
      const Powers w = deflection(psi, n);
      psi = rotation(psi, w, n);
      append(result.w, w), append(result.psi, psi);
      double largest = 0;
      psi.for_each([&](int, int, double c) { largest = std::max(largest, std::abs(c)); });
      if (largest < negligible) break;
    }
    return result;
  }

  /// Appends the terms of `sum`, of a degree that `terms` does not have yet.
  static void append(std::vector<Term>& terms, const Powers& sum) {
    sum.for_each([&](int a, int b, double c) {
      if (std::abs(c) > 1e-12) terms.push_back({a + b, a - b, c});
    });
  }

  double nu_, s_, curvature_;
  double sign_ = 1;  // of even fields; -1 of odd ones, where conjugation changes the sign
};

TipSeries::TipSeries(const plate::Section& section, double radius, int order, bool heated, double curvature)
    : radius_(radius) {
  const double D = section.bending_stiffness(), S = section.shear_stiffness();
  Maker maker(section.poisson, S * radius * radius / D, curvature * radius);
  const auto fields = maker.fields(order, heated);
  factors_.resize(3, Eigen::Index(fields.size()));
  const double root = std::sqrt(2 * radius);
  for (const auto& field : fields) {
    // M = -D kappa with tension at z > 0, Q = S gamma
    factors_.col(size()) =
        Eigen::Vector3d(-D / radius * root, -D / radius * root, S * root).cwiseProduct(maker.ahead(field));
    orders_.push_back(field.order);
  }
  even_ = half(fields, true), odd_ = half(fields, false);
}

TipSeries::Half TipSeries::half(const std::vector<Field>& fields, bool even) {
  Half result;
  int largest = 0;  // p, and |q| <= p + 6
  const auto for_each_term = [&](const auto& visit) {
    for (std::size_t n = 0; n < fields.size(); ++n)
      for (const bool of_w : {true, false})
        for (const auto& term : fields[n].even == even ? (of_w ? fields[n].w : fields[n].psi)
                                                       : (of_w ? fields[n].w_of_curve : fields[n].psi_of_curve))
          visit(n, of_w, term);
  };
  for_each_term([&](std::size_t, bool, const Term& term) { largest = std::max(largest, term.twice_p); });
  const int width = 2 * largest + 13;
  std::vector<Eigen::Index> index(std::size_t((largest + 1) * width), -1);
  const auto place = [&](int p, int q) -> Eigen::Index& { return index[std::size_t(p * width + q + largest + 6)]; };
  for_each_term([&](std::size_t n, bool, const Term& term) {
    place(term.twice_p, term.twice_q) = 0;
    if (result.fields.empty() || result.fields.back() != Eigen::Index(n)) result.fields.push_back(Eigen::Index(n));
  });
  for (int p = 0; p <= largest; ++p)
    for (int q = -largest - 6; q <= largest + 6; ++q)
      if (auto& at = place(p, q); at == 0) at = Eigen::Index(result.terms.size()), result.terms.emplace_back(p, q);
  result.w = result.psi = Eigen::MatrixXd::Zero(Eigen::Index(result.terms.size()), Eigen::Index(result.fields.size()));
  Eigen::Index column = 0;
  for_each_term([&](std::size_t n, bool of_w, const Term& term) {
    while (result.fields[std::size_t(column)] != Eigen::Index(n)) ++column;
    (of_w ? result.w : result.psi)(place(term.twice_p, term.twice_q), column) = term.c;
  });
  return result;
}

Eigen::MatrixXd TipSeries::operator()(const std::vector<Polar>& places) const {
  const auto count = Eigen::Index(places.size());
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(plate::unknowns_per_point * count, size());
  for (const bool even : {true, false}) {
    const Half& half = even ? even_ : odd_;
    Eigen::MatrixXd x(count, Eigen::Index(half.terms.size())), y(count, x.cols());
    int largest = 0;
    for (const auto& [p, q] : half.terms) largest = std::max(largest, std::abs(q));
    std::vector<std::complex<double>> directions(std::size_t(largest + 1), 1);
    for (Eigen::Index k = 0; k < count; ++k) {
      const auto [r, angle] = places[std::size_t(k)];
      // powers by multiplication: terms come in ascending p
      const double root = std::sqrt(r / radius_);
      const std::complex<double> turn = std::polar(1.0, angle / 2);
      for (std::size_t q = 1; q < directions.size(); ++q) directions[q] = turn * directions[q - 1];
      double power = 1;
      for (std::size_t t = 0; t < half.terms.size(); ++t) {
        const auto [p, q] = half.terms[t];
        for (int n = t ? half.terms[t - 1].first : 0; n < p; ++n) power *= root;
        const auto direction = q < 0 ? std::conj(directions[std::size_t(-q)]) : directions[std::size_t(q)];
        x(k, Eigen::Index(t)) = power * direction.real(), y(k, Eigen::Index(t)) = power * direction.imag();
      }
    }
    const Eigen::MatrixXd w = radius_ * (even ? x : y) * half.w * (even ? 1 : -1);
    const Eigen::MatrixXd first = (even ? x : y) * half.psi * (even ? 1 : -1), second = (even ? y : x) * half.psi;
    for (std::size_t i = 0; i < half.fields.size(); ++i)
      for (Eigen::Index k = 0; k < count; ++k)
        result.col(half.fields[i]).segment<plate::unknowns_per_point>(plate::index_by_points(k, 0)) +=
            plate::PointValues(w(k, Eigen::Index(i)), first(k, Eigen::Index(i)), second(k, Eigen::Index(i)));
  }
  return result;
}

namespace {

using geometry::Point;

/// Relative tolerance of a radius: circles go through points of a lattice (5 layers of a plate 5 spacings thick do, at
/// (4.5, 6.5)), which must be all in or all out. By rounding alone K2 was 1e-4 of K1 in a symmetric plate.
constexpr double rounding = 1e-9;

/// Points; 16 spacings about a tip hold 800.
constexpr std::size_t enough = 1200;

std::vector<std::uint32_t> points_within(const TipView& plate, const TipFrame& frame, const FitRange& range) {
  std::vector<std::uint32_t> result;
  for (std::uint32_t k = 0; k < plate.plate_points; ++k) {
    const Point x = frame.local(plate.positions[k]);
    const double r = x.norm();
    if (r < range.inner * (1 - rounding) || r > range.outer * (1 + rounding)) continue;
    if (x.x() < 0 && std::abs(frame.curve.empty() ? x.y() : frame.beside(plate.positions[k]).y()) < plate.doubtful)
      continue;
    result.push_back(k);
  }
  // more points than the fields need cost time only
  const std::size_t stride = (result.size() + enough - 1) / enough;
  for (std::size_t i = 0; stride > 1 && i * stride < result.size(); ++i) result[i] = result[i * stride];
  if (stride > 1) result.resize((result.size() + stride - 1) / stride);
  return result;
}

/// The row of a fit of the fields (columns; three rows a point, weighted) to a state: K = F R^-1 Q^T of their QR.
Eigen::MatrixXd rows_of(Eigen::MatrixXd fields, const Eigen::Matrix3Xd& factors) {
  const Eigen::VectorXd scale = fields.colwise().norm().cwiseInverse();
  fields = fields * scale.asDiagonal();
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(fields);
  const Eigen::MatrixXd wanted = (factors * scale.asDiagonal()).transpose();
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(fields.rows(), 3);
  rows.topRows(fields.cols()) =
      qr.matrixQR().topRows(fields.cols()).triangularView<Eigen::Upper>().transpose().solve(wanted);
  rows.applyOnTheLeft(qr.householderQ());
  return rows;
}

}  // namespace

std::vector<SeriesFit> series_fits(const TipView& plate, const TipFrame& frame, const FitRange& range,
                                   const std::vector<double>& shares, bool heated) {
  const auto points = points_within(plate, frame, range);
  const plate::Section section = plate.section.at(frame.origin);
  const TipSeries series(section, range.outer, range.order, heated, frame.curvature);
  std::vector<Polar> places;
  for (const auto k : points) places.push_back(polar(frame, plate.positions[k], plate.spacing));
  const Eigen::MatrixXd fields = series(places);
  // of w / outer, psi_x', psi_y' to w, theta_x, theta_y: psi = (-theta_y, theta_x)
  const Point left = frame.left();
  Eigen::Matrix3d turn;
  turn << 1 / range.outer, 0, 0, 0, frame.ahead.y(), -frame.ahead.x(), 0, left.y(), -left.x();

  std::vector<SeriesFit> result;
  for (const double share : shares) {
    FitRange narrower{range.inner, share * range.outer,
                      share == 1 ? range.order : fit_order(section, share * range.outer)};
    std::vector<Eigen::Index> within, columns;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (places[i].r <= narrower.outer * (1 + rounding)) within.push_back(Eigen::Index(i));
    for (std::size_t n = 0; n < series.orders().size(); ++n)
      if (series.orders()[n] <= narrower.order) columns.push_back(Eigen::Index(n));
    constexpr double least_surplus = 1.5;  // equations per unknown
    if (plate::unknowns_per_point * double(within.size()) < least_surplus * double(columns.size())) break;
    SeriesFit fit{narrower, {}, Eigen::Matrix3Xd(3, plate::unknowns_per_point * Eigen::Index(within.size()))};
    Eigen::MatrixXd own(plate::unknowns_per_point * Eigen::Index(within.size()), Eigen::Index(columns.size()));
    std::vector<double> weight;
    for (std::size_t i = 0; i < within.size(); ++i) {
      fit.points.push_back(points[std::size_t(within[i])]);
      weight.push_back(std::sqrt(plate.areas[fit.points.back()]));
      const plate::PointValues each = weight.back() * plate::PointValues(1 / range.outer, 1, 1);
      own.middleRows(plate::index_by_points(Eigen::Index(i), 0), plate::unknowns_per_point) =
          each.asDiagonal() *
          fields.middleRows(plate::index_by_points(within[i], 0), plate::unknowns_per_point)(Eigen::all, columns);
    }
    const Eigen::MatrixXd rows = rows_of(std::move(own), series.factors()(Eigen::all, columns));
    for (std::size_t i = 0; i < within.size(); ++i)
      fit.row.middleCols(plate::index_by_points(Eigen::Index(i), 0), plate::unknowns_per_point) =
          weight[i] *
          rows.middleRows(plate::index_by_points(Eigen::Index(i), 0), plate::unknowns_per_point).transpose() * turn;
    result.push_back(std::move(fit));
  }
  return result;
}

Eigen::Vector3d SeriesFit::operator()(const NearField& field) const {
  Eigen::Vector3d K = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto u = field(points[i]);
    K += row.middleCols(plate::index_by_points(Eigen::Index(i), 0), plate::unknowns_per_point) *
         plate::PointValues(u.w, u.theta_x, u.theta_y);
  }
  return K;
}

int fit_order(const plate::Section& section, double outer) {
  if (section.law == plate::PlateLaw::membrane) return 6;
  return 6 + int(std::ceil(3 * outer * std::sqrt(12 * section.shear_correction) / section.thickness));
}

std::optional<FitRange> fit_range(const plate::Section& section, double clear, double spacing, bool graded) {
  constexpr double least = 4, usual = 16;  // spacings
  constexpr double resolved = 5,
                   possible = 7;  // widths of the layer beside the faces; beyond, the series has too many fields
  const double layer = section.layer();
  // where nu < 0, fields of higher order look like the first one
  const double softness = std::min(1.0, (1 + section.poisson) / (1 - section.poisson));
  double outer = std::min(0.6 * clear, resolved * std::sqrt(softness) * layer);
  // graded points resolve the layer beside the faces only near the tip
  outer = std::min(outer, graded ? std::max(usual * spacing, 2.5 * layer) : usual * spacing);
  if (outer < least * spacing) outer = std::min(0.9 * clear, least * spacing);
  if (outer < least * spacing || outer > possible * layer) return std::nullopt;
  return FitRange{std::max(2.5 * spacing, 0.15 * outer), outer, fit_order(section, outer)};
}

}  // namespace post
