// Points, triangles, families and nodal normals of a rectangle, of its image under a map and of a part of its cells;
// the formulations' gradients and their integration; variational consistency: correction functions and the one linear
// system of the correction factors.
#include "cases/papers/bodies/galerkin/systems.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

namespace galerkin_systems {
namespace {

Eigen::Matrix2Xd lattice_points(const Lattice& l) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-l.perturbation, l.perturbation);
  const double dx = l.width / l.columns, dy = l.height / l.rows;
  Eigen::Matrix2Xd points(2, (l.columns + 1) * (l.rows + 1));
  int k = 0;
  for (int r = 0; r <= l.rows; ++r)
    for (int c = 0; c <= l.columns; ++c) {
      const double x = uniform(random), y = uniform(random);
      const bool side = c == 0 || c == l.columns, end = r == 0 || r == l.rows;
      points.col(k++) = Eigen::Vector2d((c + (side ? 0 : x)) * dx, (r + (end ? 0 : y)) * dy);
    }
  return points;
}

std::vector<Nodes> lattice_families(const Lattice& l) {
  std::vector<Nodes> families;
  for (int r = 0; r <= l.rows; ++r)
    for (int c = 0; c <= l.columns; ++c) {
      Nodes nodes{r * (l.columns + 1) + c};
      const int reach = l.reach == Reach::cells ? 1 : 2;
      for (int dr = -reach; dr <= reach; ++dr)
        for (int dc = -reach; dc <= reach; ++dc) {
          const bool inside = r + dr >= 0 && r + dr <= l.rows && c + dc >= 0 && c + dc <= l.columns;
          const bool near = l.reach != Reach::circle || dr * dr + dc * dc < 2.51 * 2.51;
          if (inside && near && (dr != 0 || dc != 0)) nodes.push_back((r + dr) * (l.columns + 1) + c + dc);
        }
      families.push_back(nodes);
    }
  return families;
}

void lay_cells(Body& b, const Lattice& l) {
  for (int r = 0; r < l.rows; ++r)
    for (int c = 0; c < l.columns; ++c) {
      const int k = r * (l.columns + 1) + c;
      b.cells.push_back({k, k + 1, k + l.columns + 2, k + l.columns + 1});
    }
}

/// Both diagonals of every cell: four triangles, each counted half.
void cut_cells(Body& b) {
  for (const auto& q : b.cells)
    for (std::size_t i = 0; i < 4; ++i) b.triangles.push_back({{q[i], q[(i + 1) % 4], q[(i + 2) % 4]}, 0.5});
}

void walk_outline(Body& b, const Lattice& l) {
  const int right = l.columns, top = l.rows, row = l.columns + 1;
  for (int c = 0; c < right; ++c) b.outline.push_back({c, c + 1});
  for (int r = 0; r < top; ++r) b.outline.push_back({r * row + right, (r + 1) * row + right});
  for (int c = right; c > 0; --c) b.outline.push_back({top * row + c, top * row + c - 1});
  for (int r = top; r > 0; --r) b.outline.push_back({r * row, (r - 1) * row});
}

/// Areas and normals of points whose triangles and outline are known.
void measure(Body& b) {
  b.areas = Eigen::VectorXd::Zero(b.points.cols());
  b.normals = Eigen::Matrix2Xd::Zero(2, b.points.cols());
  for (const Triangle& t : b.triangles) {
    Eigen::Matrix2d sides;
    sides << b.points.col(t.corners[1]) - b.points.col(t.corners[0]),
        b.points.col(t.corners[2]) - b.points.col(t.corners[0]);
    if (sides.determinant() <= 0) throw std::runtime_error("a triangle of the perturbed lattice is turned over");
    for (const int k : t.corners) b.areas[k] += t.share * sides.determinant() / 6;
  }
  for (const auto& [from, to] : b.outline) {
    const Eigen::Vector2d edge = b.points.col(to) - b.points.col(from), normal(edge.y(), -edge.x());
    b.normals.col(from) += normal / 2;
    b.normals.col(to) += normal / 2;
  }
}

/// The edges of cells that no second cell walks the other way.
std::vector<std::array<int, 2>> outline(const std::vector<std::array<int, 4>>& cells) {
  std::vector<std::array<int, 2>> edges, once;
  for (const auto& q : cells)
    for (std::size_t i = 0; i < 4; ++i) edges.push_back({q[i], q[(i + 1) % 4]});
  for (const auto& [from, to] : edges)
    if (std::find(edges.begin(), edges.end(), std::array{to, from}) == edges.end()) once.push_back({from, to});
  return once;
}

int position(const Nodes& nodes, int node) {
  return int(std::find(nodes.begin(), nodes.end(), node) - nodes.begin());
}

/// Node coordinates relative to one of the list.
Eigen::Matrix2Xd bonds(const Body& b, const Nodes& nodes, int at) {
  Eigen::Matrix2Xd X(2, nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) X.col(Eigen::Index(i)) = b.points.col(nodes[i]);
  return X.colwise() - Eigen::Vector2d(X.col(at));
}

/// omega V_i = V_i / r^2, zero at the reference point, Bode 5.41, 5.42.
Eigen::VectorXd weights(const Body& b, const Nodes& nodes, int at) {
  const Eigen::Matrix2Xd X = bonds(b, nodes, at);
  Eigen::VectorXd w(nodes.size());
  for (int i = 0; i < w.size(); ++i) w[i] = i == at ? 0 : b.areas[nodes[std::size_t(i)]] / X.col(i).squaredNorm();
  return w;
}

/// Weighted least squares of a basis without a constant: its coefficients per node, those of `at` closing the sum.
Eigen::MatrixXd taylor_coefficients(const Eigen::MatrixXd& basis, const Eigen::VectorXd& w, int at) {
  Eigen::MatrixXd coefficients = (basis * w.asDiagonal() * basis.transpose()).ldlt().solve(basis * w.asDiagonal());
  coefficients.col(at).setZero();
  coefficients.col(at) = -coefficients.rowwise().sum();
  return coefficients;
}

/// x, y, x^2/2, xy, y^2/2 of each bond of the master, lengths in units of `scale`.
Eigen::MatrixXd quadratic_basis(const Eigen::Matrix2Xd& X, double scale) {
  Eigen::MatrixXd p(5, X.cols());
  p.topRows(2) = X / scale;
  p.row(2) = p.row(0).cwiseAbs2() / 2;
  p.row(3) = p.row(0).cwiseProduct(p.row(1));
  p.row(4) = p.row(1).cwiseAbs2() / 2;
  return p;
}

/// Bode 5.55: the gradient's part along the bond to node `at` is the bond's own difference quotient.
Sample bond_conforming(Sample s, const Eigen::Vector2d& X) {
  s.bond = X.normalized();
  s.gradient -= s.bond * (s.bond.transpose() * s.gradient);
  s.gradient.col(s.at) += X / X.squaredNorm();
  s.gradient.col(0) -= X / X.squaredNorm();
  return s;
}

/// Second derivatives N,xx N,xy N,yx N,yy at the master of moving least squares that heed the master much more than
/// the rest, as Bode 6.28: twice the symmetric gradient of the moving slope g, g,a = K^-1 sum omega_i,a X_i
/// (f_i - g.X_i).
Eigen::MatrixXd moving_second_derivatives(const Body& b, const Nodes& nodes) {
  const Eigen::Matrix2Xd X = bonds(b, nodes, 0);
  const Eigen::VectorXd w = weights(b, nodes, 0);
  const Eigen::Matrix2d inverse = (X * w.asDiagonal() * X.transpose()).inverse();
  const Eigen::MatrixXd residual =
      Eigen::MatrixXd::Identity(w.size(), w.size()) - X.transpose() * inverse * X * w.asDiagonal();
  Eigen::MatrixXd slope(4, w.size());
  for (Eigen::Index a = 0; a < 2; ++a) {
    Eigen::VectorXd dw = w;  // by the point of evaluation; w is zero at the master
    for (Eigen::Index i = 1; i < w.size(); ++i) dw[i] *= 2 * X(a, i) / X.col(i).squaredNorm();
    slope.middleRows(2 * a, 2) = inverse * X * dw.asDiagonal() * residual;
  }
  Eigen::MatrixXd N(4, w.size());
  N << 2 * slope.row(0), slope.row(1) + slope.row(2), slope.row(1) + slope.row(2), 2 * slope.row(3);
  N.col(0).setZero();
  N.col(0) = -N.rowwise().sum();
  return N;
}

double family_area(const Body& b, const Nodes& nodes) {
  double sum = 0;
  for (const int i : nodes) sum += b.areas[i];
  return sum;
}

/// A system with one sample per node of each family, weights V_k V_j / sum V.
template <typename SampleAt>
System family_integrated(const Body& b, const SampleAt& sample_at) {
  System system;
  for (const Nodes& nodes : b.families) {
    Family f{nodes, {}};
    const double area = family_area(b, nodes);
    for (int j = 0; j < int(nodes.size()); ++j) {
      f.samples.push_back(sample_at(nodes, j));
      f.samples.back().weight = b.areas[nodes[0]] * b.areas[nodes[std::size_t(j)]] / area;
    }
    system.push_back(std::move(f));
  }
  return system;
}

/// N^kki - delta_ki of a weighted least-squares fit whose basis holds a constant, in both components.
Eigen::Matrix2Xd shape_correction(const Body& b, const Nodes& nodes, bool quadratic) {
  const double scale = std::sqrt(b.areas[nodes[0]]);
  Eigen::MatrixXd p(quadratic ? 6 : 3, nodes.size());
  Eigen::VectorXd w(nodes.size());
  for (int i = 0; i < p.cols(); ++i) {
    const Eigen::Vector2d X = (b.points.col(nodes[std::size_t(i)]) - b.points.col(nodes[0])) / scale;
    p.col(i).head(3) << 1, X.x(), X.y();
    if (quadratic) p.col(i).tail(3) << X.x() * X.x(), X.x() * X.y(), X.y() * X.y();
    w[i] = i == 0 ? 0 : b.areas[nodes[std::size_t(i)]] / X.squaredNorm();
  }
  const Eigen::MatrixXd mass = p * w.asDiagonal() * p.transpose();
  const Eigen::VectorXd origin = Eigen::VectorXd::Unit(p.rows(), 0);
  Eigen::RowVectorXd N = mass.ldlt().solve(origin).transpose() * p * w.asDiagonal();
  N[0] -= 1;
  return N.replicate(2, 1);
}

Eigen::Matrix2d projector(const Sample& s) {
  return Eigen::Matrix2d::Identity() - s.bond * s.bond.transpose();
}

/// Place of each point among those whose factors along axis d are open, -1 of the others.
std::vector<int> open_places(const Body& b, Normals normals, int d) {
  std::vector<int> places(std::size_t(b.points.cols()), 0);
  if (normals != Normals::given)
    for (const auto& edge : b.outline) {
      const Eigen::Vector2d along = b.points.col(edge[1]) - b.points.col(edge[0]);
      const bool across = along[1 - d] != 0;
      for (const int k : edge)
        if (normals == Normals::found || across) places[std::size_t(k)] = -1;
    }
  int count = 0;
  for (int& place : places)
    if (place == 0) place = count++;
  return places;
}

}  // namespace

Body body(const Lattice& l, const Map& map) {
  Body b{lattice_points(l), {}, {}, {}, {}, lattice_families(l), {}, l.width, l.height};
  if (map)
    for (Eigen::Index k = 0; k < b.points.cols(); ++k) b.points.col(k) = map(b.points.col(k));
  lay_cells(b, l);
  cut_cells(b);
  walk_outline(b, l);
  measure(b);
  return b;
}

Part part(const Body& whole, const std::function<bool(const Eigen::Vector2d&)>& holds) {
  Part p{{}, {}};
  std::vector<int> name(std::size_t(whole.points.cols()), -1);
  std::vector<bool> inside(name.size(), false);
  for (const auto& q : whole.cells) {
    const Eigen::Vector2d middle = whole.points(Eigen::all, q).rowwise().mean();
    if (!holds(middle)) continue;
    p.body.cells.push_back(q);
    for (const int k : q) inside[std::size_t(k)] = true;
  }
  for (std::size_t k = 0; k < inside.size(); ++k)
    if (inside[k]) {
      name[k] = int(p.names.size());
      p.names.push_back(int(k));
    }
  p.body.points = whole.points(Eigen::all, p.names);
  for (auto& q : p.body.cells)
    for (int& k : q) k = name[std::size_t(k)];
  for (const int k : p.names) {
    Nodes family;
    for (const int i : whole.families[std::size_t(k)])
      if (inside[std::size_t(i)]) family.push_back(name[std::size_t(i)]);
    p.body.families.push_back(family);
  }
  p.body.width = whole.width, p.body.height = whole.height;
  p.body.outline = outline(p.body.cells);
  cut_cells(p.body);
  measure(p.body);
  return p;
}

System renamed(System system, const Nodes& names) {
  for (Family& f : system)
    for (int& node : f.nodes) node = names[std::size_t(node)];
  return system;
}

System operator+(System a, const System& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

System operator*(double factor, System a) {
  for (Family& f : a)
    for (Sample& s : f.samples) s.weight *= factor;
  return a;
}

System central_average(const Body& b) {
  System system;
  for (const Nodes& nodes : b.families)
    system.push_back({nodes, {{Eigen::Matrix2Xd::Zero(2, nodes.size()), b.areas[nodes[0]]}}});
  for (const Triangle& t : b.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      // A grad phi_i: half the opposite side, turned inwards
      const Eigen::Vector2d side = b.points.col(t.corners[(i + 2) % 3]) - b.points.col(t.corners[(i + 1) % 3]);
      for (const int k : t.corners) {
        Family& f = system[std::size_t(k)];
        f.samples[0].gradient.col(position(f.nodes, t.corners[i])) +=
            t.share / (6 * b.areas[k]) * Eigen::Vector2d(-side.y(), side.x());
      }
    }
  return system;
}

System linear_static(const Body& b) {
  System system;
  for (const Nodes& nodes : b.families) system.push_back({nodes, {{taylor_gradient(b, nodes, 0), b.areas[nodes[0]]}}});
  return system;
}

System moving(const Body& b, bool bond_corrected) {
  return family_integrated(b, [&](const Nodes& nodes, int j) {
    const Sample s{taylor_gradient(b, nodes, j), 0, 1, j};
    return bond_corrected && j != 0 ? bond_conforming(s, bonds(b, nodes, 0).col(j)) : s;
  });
}

System quadratic_static(const Body& b) {
  return family_integrated(b, [&](const Nodes& nodes, int j) {
    const auto d = quadratic_derivatives(b, nodes);
    const Eigen::Vector2d X = bonds(b, nodes, 0).col(j);
    Sample s{d.topRows(2), 0, 1, j};
    s.gradient.row(0) += X.x() * d.row(2) + X.y() * d.row(3);
    s.gradient.row(1) += X.x() * d.row(3) + X.y() * d.row(4);
    return s;
  });
}

System bilinear(const Body& b) {
  const double gauss = 1 / std::numbers::sqrt3;
  const Eigen::Matrix<double, 2, 4> corners{{-1, 1, 1, -1}, {-1, -1, 1, 1}};
  System system;
  for (const auto& cell : b.cells) {
    Family f{{cell.begin(), cell.end()}, {}};
    const Eigen::Matrix2Xd X = bonds(b, f.nodes, 0);
    for (int g = 0; g < 4; ++g) {
      const Eigen::Vector2d at = gauss * corners.col(g);
      Eigen::Matrix2Xd d(2, 4);
      for (int i = 0; i < 4; ++i) {
        d(0, i) = corners(0, i) * (1 + corners(1, i) * at.y()) / 4;
        d(1, i) = corners(1, i) * (1 + corners(0, i) * at.x()) / 4;
      }
      const Eigen::Matrix2d jacobian = d * X.transpose();
      f.samples.push_back({jacobian.inverse() * d, jacobian.determinant()});
    }
    system.push_back(f);
  }
  return system;
}

System bond_residuals(const Body& b, const System& u1, double bending, double shear) {
  System system;
  for (const Family& master : u1) {
    Family f{master.nodes, {}};
    const Eigen::Matrix2Xd X = bonds(b, f.nodes, 0);
    const double k = b.areas[f.nodes[0]], others = family_area(b, f.nodes) - k;
    for (int j = 1; j < int(f.nodes.size()); ++j) {
      Sample s{master.samples[0].gradient, 0, 1, j};
      s = bond_conforming(s, X.col(j));
      s.gradient -= master.samples[0].gradient;
      s.weight = bending * k * b.areas[f.nodes[std::size_t(j)]] / others;
      s.shear = shear / bending;
      f.samples.push_back(s);
    }
    system.push_back(f);
  }
  return system;
}

System implicit_gradients(const Body& b) {
  System system;
  for (const Nodes& nodes : b.families) {
    const Eigen::MatrixXd d = moving_second_derivatives(b, nodes);
    const double moment = b.areas[nodes[0]] * b.areas[nodes[0]] / (4 * std::numbers::pi);
    system.push_back({nodes, {{d.topRows(2), moment}, {d.bottomRows(2), moment}}});
  }
  return system;
}

System shear_scaled(const Body& b, System system, double thickness, double c) {
  for (Family& f : system)
    for (Sample& s : f.samples) s.shear *= thickness * thickness / (thickness * thickness + c * b.areas[f.nodes[0]]);
  return system;
}

Eigen::Matrix2Xd taylor_gradient(const Body& b, const Nodes& nodes, int at) {
  return taylor_coefficients(bonds(b, nodes, at), weights(b, nodes, at), at);
}

Eigen::Matrix<double, 5, Eigen::Dynamic> quadratic_derivatives(const Body& b, const Nodes& nodes) {
  const double scale = std::sqrt(b.areas[nodes[0]]);
  Eigen::MatrixXd d = taylor_coefficients(quadratic_basis(bonds(b, nodes, 0), scale), weights(b, nodes, 0), 0);
  d.topRows(2) /= scale;
  d.bottomRows(3) /= scale * scale;
  return d;
}

Eigen::Matrix2Xd nodal_normals(const Body& b, const System& system) {
  Eigen::Matrix2Xd sum = Eigen::Matrix2Xd::Zero(2, b.points.cols());
  for (const Family& f : system)
    for (const Sample& s : f.samples)
      for (std::size_t i = 0; i < f.nodes.size(); ++i)
        sum.col(f.nodes[i]) += s.weight * s.gradient.col(Eigen::Index(i));
  return sum;
}

Eigen::Matrix2Xd constant_correction(const Body&, const Nodes& nodes) {
  Eigen::Matrix2Xd phi = Eigen::Matrix2Xd::Ones(2, nodes.size());
  phi.col(0).setConstant(1 - double(nodes.size()));
  return phi;
}

Eigen::Matrix2Xd second_derivative_correction(const Body& b, const Nodes& nodes) {
  const auto d = quadratic_derivatives(b, nodes);
  Eigen::Matrix2Xd phi(2, nodes.size());
  phi << d.row(2), d.row(4);
  return b.areas[nodes[0]] * phi;
}

Eigen::Matrix2Xd linear_correction(const Body& b, const Nodes& nodes) {
  return shape_correction(b, nodes, false);
}

Eigen::Matrix2Xd quadratic_correction(const Body& b, const Nodes& nodes) {
  return shape_correction(b, nodes, true);
}

System variationally_consistent(const Body& b, System system, const Correction& correction, Normals normals) {
  const auto n = Eigen::Index(system.size());
  std::vector<Eigen::Matrix2Xd> phi;
  for (const Family& f : system) phi.push_back(correction(b, f.nodes));
  // beta_k = sum w (I - n n) alpha_k decouples the components
  const Eigen::Matrix2Xd error = nodal_normals(b, system) - b.normals;
  Eigen::Matrix2Xd beta = Eigen::Matrix2Xd::Zero(2, n);
  for (int d = 0; d < 2; ++d) {
    const auto places = open_places(b, normals, d);
    const auto place = [&](Eigen::Index k) { return places[std::size_t(k)]; };
    const auto open = std::ranges::count_if(places, [](int p) { return p >= 0; });
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd target(open);
    for (Eigen::Index k = 0; k < n; ++k) {
      if (place(k) < 0) continue;
      target[place(k)] = -error(d, k);
      const Nodes& nodes = system[std::size_t(k)].nodes;
      for (std::size_t i = 0; i < nodes.size(); ++i)
        if (place(nodes[i]) >= 0)
          entries.emplace_back(place(nodes[i]), place(k), phi[std::size_t(k)](d, Eigen::Index(i)));
    }
    Sparse matrix(open, open);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::VectorXd solution = least_norm(matrix, target);
    for (Eigen::Index k = 0; k < n; ++k)
      if (place(k) >= 0) beta(d, k) = solution[place(k)];
  }
  for (Eigen::Index k = 0; k < n; ++k) {
    Family& f = system[std::size_t(k)];
    Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
    for (const Sample& s : f.samples) sum += s.weight * projector(s);
    const Eigen::Vector2d alpha = sum.inverse() * beta.col(k);
    for (Sample& s : f.samples) s.gradient += projector(s) * alpha.asDiagonal() * phi[std::size_t(k)];
  }
  return system;
}

double consistency_residual(const Body& b, const System& system) {
  return (nodal_normals(b, system) - b.normals).cwiseAbs().maxCoeff();
}

Eigen::VectorXd least_norm(const Sparse& M, const Eigen::VectorXd& t) {
  // x = M^T (M M^T + shift)^-1 t, repeated on what is left: the shift has no share in the limit
  const Sparse turned = M.transpose();
  Sparse normal = M * turned, identity(M.rows(), M.rows());
  identity.setIdentity();
  normal += 1e-8 * normal.diagonal().maxCoeff() * identity;
  const Eigen::SimplicialLDLT<Sparse> factor(normal);
  if (factor.info() != Eigen::Success) throw std::runtime_error("the normal equations have no factor");
  Eigen::VectorXd x = Eigen::VectorXd::Zero(M.cols());
  for (int repeated = 0; repeated < 100; ++repeated) {
    const Eigen::VectorXd change = turned * factor.solve(t - M * x);
    x += change;
    if (change.norm() <= 1e-15 * x.norm()) break;
  }
  return x;
}

Eigen::VectorXd solved(const Sparse& K, const Eigen::VectorXd& f, const Eigen::VectorXd& prescribed) {
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd u = prescribed.unaryExpr([](double v) { return std::isnan(v) ? 0 : v; });
  std::vector<int> free_index(std::size_t(K.rows()), -1);
  std::vector<Eigen::Index> free;
  for (Eigen::Index i = 0; i < K.rows(); ++i)
    if (std::isnan(prescribed[i])) {
      free_index[std::size_t(i)] = int(free.size());
      free.push_back(i);
    }
  for (Eigen::Index j = 0; j < K.outerSize(); ++j)
    for (Sparse::InnerIterator it(K, j); it; ++it) {
      const int row = free_index[std::size_t(it.row())], column = free_index[std::size_t(it.col())];
      if (row >= 0 && column >= 0) entries.emplace_back(row, column, it.value());
    }
  Sparse reduced(Eigen::Index(free.size()), Eigen::Index(free.size()));
  reduced.setFromTriplets(entries.begin(), entries.end());
  const Eigen::VectorXd load = (f - K * u)(free);
  const Eigen::SimplicialLDLT<Sparse> factor(reduced);
  if (factor.info() != Eigen::Success) throw std::runtime_error("the stiffness has no factor");
  const Eigen::VectorXd inner = factor.solve(load);
  u(free) = inner;
  return u;
}

}  // namespace galerkin_systems
