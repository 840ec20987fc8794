#include "cases/papers/bodies/loaded.hpp"

#include "cases/papers/bodies/equilibrium.hpp"

namespace boundary_bodies {

namespace {

Eigen::Vector3d normal(const plate::SurfaceNode& face) {
  return face.side * Eigen::Vector3d::Unit(face.axis);
}

/// Differences of each component at the nodes, and the largest expected value of each.
std::pair<Eigen::ArrayXXd, Eigen::ArrayXd> differences(const Solid& s, const Eigen::VectorXd& u,
                                                       const Field& solution) {
  const int D = s.dimension();
  Eigen::ArrayXXd off(D, s.body.real);
  Eigen::ArrayXd size = Eigen::ArrayXd::Zero(D);
  for (int k = 0; k < s.body.real; ++k) {
    const Eigen::Vector3d exact = solution(s.at(k));
    for (int a = 0; a < D; ++a) {
      off(a, k) = u[D * k + a] - exact[a];
      size[a] = std::max(size[a], std::abs(exact[a]));
    }
  }
  return {off, size};
}

struct Equations {
  plate::SparseStiffness K;
  Eigen::VectorXd f;
  std::vector<plate::PrescribedUnknown> held;
};

Equations equations(const Solid& s, int order, plate::FluxRule rule, const Conditions& c) {
  const int D = s.dimension(), real = s.body.real, surface = int(s.body.surface.size());
  Equations e{stiffness(s, plate::Centre::surface_node, order, rule), Eigen::VectorXd::Zero(D * (real + surface)), {}};
  e.f.head(D * real) = loads(s, c);
  for (int i = 0; i < surface; ++i) {
    const auto& face = s.body.surface[std::size_t(i)];
    const Eigen::Vector3d p = c.traction(s.at_surface(i), normal(face)), u = c.displacement(s.at_surface(i));
    for (int a = 0; a < D; ++a) {
      const int unknown = D * (real + i) + a;
      if (c.held(face, a))
        e.held.push_back({unknown, u[a]});
      else
        e.f[unknown] = s.area() * p[a];
    }
  }
  return e;
}

/// All unknowns from those on the lower side of the middle of an axis; and the places of these among all.
std::pair<plate::SparseStiffness, std::vector<int>> mirror(const Solid& s, int axis) {
  const int D = s.dimension(), real = s.body.real;
  int last = 0;
  for (int k = 0; k < real; ++k) last = std::max(last, s.body.nodes[std::size_t(k)][axis]);
  const auto image = [&](int k) {
    plate::LatticeBody::Index place = s.body.nodes[std::size_t(k)];
    place[axis] = last - place[axis];
    return s.body.node(place);
  };
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<int> lower;
  const auto add = [&](int k, int image_of_k, int node) {
    if (2 * s.body.nodes[std::size_t(node)][axis] > last) return;
    for (int a = 0; a < D; ++a) {
      entries.emplace_back(D * k + a, int(lower.size()), 1.0);
      entries.emplace_back(D * image_of_k + a, int(lower.size()), a == axis ? -1.0 : 1.0);
      lower.push_back(D * k + a);
    }
  };
  for (int k = 0; k < real; ++k) add(k, image(k), k);
  for (int i = 0; i < int(s.body.surface.size()); ++i) {
    const auto& face = s.body.surface[std::size_t(i)];
    const int other = s.body.surface_node(image(face.inner), face.axis, face.axis == axis ? -face.side : face.side);
    add(real + i, real + other, face.inner);
  }
  plate::SparseStiffness all(D * (real + Eigen::Index(s.body.surface.size())), Eigen::Index(lower.size()));
  all.setFromTriplets(entries.begin(), entries.end());
  return {all, lower};
}

}  // namespace

Eigen::VectorXd loads(const Solid& s, const Conditions& c) {
  const int D = s.dimension();
  Eigen::VectorXd f(D * s.body.real);
  for (int k = 0; k < s.body.real; ++k) {
    const Eigen::Vector3d load = c.load(s.at(k));
    for (int a = 0; a < D; ++a) f[D * k + a] = s.volume() * load[a];
  }
  return f;
}

Eigen::VectorXd with_surface_nodes(const Solid& s, int order, plate::FluxRule rule, const Conditions& c) {
  const auto [K, f, held] = equations(s, order, rule, c);
  return constrained_solution(K, f, held).values;
}

Eigen::VectorXd with_surface_nodes_mirrored(const Solid& s, int order, plate::FluxRule rule, const Conditions& c,
                                            int axis) {
  const auto [K, f, held] = equations(s, order, rule, c);
  const auto [all, lower] = mirror(s, axis);
  std::vector<plate::PrescribedUnknown> lower_held;
  for (const auto& one : held)
    if (const auto found = std::ranges::find(lower, one.unknown); found != lower.end())
      lower_held.push_back({found - lower.begin(), one.value});
  const plate::SparseStiffness folded = plate::SparseStiffness(all.transpose()) * K * all;
  return all * constrained_solution(folded, all.transpose() * f, lower_held).values;
}

Eigen::VectorXd on_nodes(const Solid& s, const plate::SparseStiffness& K, const Conditions& c, const Field& solution) {
  const int D = s.dimension();
  Eigen::VectorXd f = loads(s, c);
  std::vector<plate::PrescribedUnknown> held;
  for (int i = 0; i < int(s.body.surface.size()); ++i) {
    const auto& face = s.body.surface[std::size_t(i)];
    const Eigen::Vector3d p = c.traction(s.at_surface(i), normal(face)), u = solution(s.at(face.inner));
    for (int a = 0; a < D; ++a) {
      const int unknown = D * face.inner + a;
      if (c.held(face, a))
        held.push_back({unknown, u[a]});
      else
        f[unknown] += s.area() * p[a];
    }
  }
  return constrained_solution(K, f, held).values;
}

Eigen::VectorXd uncorrected(const Solid& s, const Conditions& c, const Field& solution) {
  return on_nodes(s, uncorrected_stiffness(s), c, solution);
}

Errors errors(const Solid& s, const Eigen::VectorXd& u, const Field& solution) {
  const auto [off, size] = differences(s, u, solution);
  const Eigen::ArrayXd all = (off.colwise() / size).matrix().colwise().norm().transpose();
  return {all.maxCoeff(), all.mean()};
}

Eigen::VectorXd largest_errors(const Solid& s, const Eigen::VectorXd& u, const Field& solution) {
  const auto [off, size] = differences(s, u, solution);
  return off.abs().rowwise().maxCoeff() / size;
}

Conditions pulled(int axis, double p) {
  const auto none = [](const Eigen::Vector3d&) { return Eigen::Vector3d(0, 0, 0); };
  return {[](const plate::SurfaceNode& face, int component) { return face.side < 0 && face.axis == component; }, none,
          [axis, p](const Eigen::Vector3d&, const Eigen::Vector3d& n) {
            return Eigen::Vector3d(std::max(0.0, n[axis]) * p * Eigen::Vector3d::Unit(axis));
          },
          none};
}

}  // namespace boundary_bodies
