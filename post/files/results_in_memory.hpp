#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "post/files/table.hpp"

namespace post {

/// The results of a run in memory, in types of the standard library alone: who reads them may be compiled for another
/// instruction set, which decides how Eigen lays out its memory.
struct ResultsInMemory {
  /// Rows of `width` numbers one after another.
  struct Array {
    std::vector<double> values;
    std::size_t width = 1;
  };
  /// The fields of a frame by the names that they have for ParaView (vtk_series.hpp), x (2 per point) and area; its
  /// cells. After the points come the corners of cells on edges and cracks, with no area.
  struct Fields {
    double time = 0;
    std::map<std::string, Array> arrays;
    std::vector<std::uint32_t> quads, triangles;
  };

  bool wants_fields = true;
  std::string resolved, summary;  // the whole case as text; as summary.json
  std::vector<std::pair<std::string, Table>> tables;
  std::vector<Fields> frames;
  std::vector<Array> cracks;  // of a growth: 2 per vertex
  std::map<std::string, ResultsInMemory>
      parts;  // of runs that it took: the motion after a growth, the other formulation
};

}  // namespace post
