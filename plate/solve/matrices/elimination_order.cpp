#include <algorithm>

#include "plate/model/numerical_error.hpp"
#include "plate/solve/matrices/cholmod.hpp"
#include "plate/solve/matrices/factor.hpp"

namespace plate {
namespace {

constexpr std::size_t few = 10000;  // points

/// The graph of the points with unknowns, lower triangle.
struct Graph {
  std::vector<int> first, row;

  Graph(const PointMatrix& matrix, const std::vector<int>& place) {
    for (std::size_t k = 0; k < matrix.points(); ++k) {
      if (place[k] < 0) continue;
      first.push_back(int(row.size()));
      for (auto b = matrix.first[k]; b < matrix.first[k + 1]; ++b)
        if (const auto at = place[matrix.row[b]]; at >= 0) row.push_back(at);
    }
    first.push_back(int(row.size()));
  }
  cholmod_sparse view() {
    cholmod_sparse result{};
    result.nrow = result.ncol = first.size() - 1;
    result.nzmax = row.size();
    result.p = first.data(), result.i = row.data();
    result.stype = -1;
    result.itype = CHOLMOD_INT, result.xtype = CHOLMOD_PATTERN, result.dtype = CHOLMOD_DOUBLE;
    result.sorted = result.packed = 1;
    return result;
  }
};

}  // namespace

std::vector<int> elimination_order(const PointMatrix& matrix, const Forces& diagonal) {
  std::vector<int> points, place(matrix.points(), -1);
  for (std::size_t k = 0; k < matrix.points(); ++k)
    if ((diagonal.col(Eigen::Index(k)).array() > 0).any()) place[k] = int(points.size()), points.push_back(int(k));
  if (points.empty()) return points;
  Graph graph(matrix, place);
  auto view = graph.view();
  Common common;
  common->supernodal = CHOLMOD_SIMPLICIAL;  // the order is all that is asked for
  common->nmethods = 1;
  common->method[0].ordering = points.size() < few ? CHOLMOD_AMD : CHOLMOD_METIS;
  cholmod_factor* analysis = cholmod_analyze(&view, &common);
  if (!analysis) throw NumericalError("no order of elimination was found");
  std::vector<int> result;
  for (std::size_t i = 0; i < points.size(); ++i)
    result.push_back(points[std::size_t(static_cast<const int*>(analysis->Perm)[i])]);
  cholmod_free_factor(&analysis, &common);
  return result;
}

}  // namespace plate
