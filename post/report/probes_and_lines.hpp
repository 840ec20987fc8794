#pragma once
#include <string>
#include <vector>

#include "geometry/shape/outline.hpp"
#include "plate/formulation/crack_springs.hpp"
#include "post/files/recorder.hpp"
#include "post/files/summary.hpp"

namespace plate {
class Formulation;
}  // namespace plate

namespace post {

struct Frame;

/// Interpolation at a place by points of the plate alone, whose states and moments a frame has: without surface nodes.
/// @throws plate::Refused  no points about the place
std::vector<plate::PlaceShare> place_in_frames(const plate::Formulation& plate, const geometry::Point& at);

/// Deflection, rotations, moments, forces, von Mises stress and the principal stresses of both faces (sigma1 >= sigma2,
/// angle of sigma1 from x in degrees) of a frame of the plate at probes, with u, v and membrane forces where loads act
/// in the plane. Of bonds that several processes share displacements alone: what ghosts
/// carry is not known.
std::vector<ProbeValue> values_at(const std::vector<Probe>& probes, const Frame& frame,
                                  const plate::Formulation& plate);

/// Places along a straight line, equally spaced on every piece of it that lies within the plate.
struct SampledLine {
  std::string name;
  geometry::Point from, to;
  std::vector<Probe> places;  // of the name of the line
  std::vector<double> along;  // distance of every place from the first point [length]
  std::vector<bool> joined;   // to the place before, with no gap
};

/// @throws plate::Refused  no points about a place
SampledLine sampled_line(const std::string& name, const geometry::Point& from, const geometry::Point& to,
                         const plate::Formulation& plate);

/// Rows of lines.csv: `time`, the line, s, x, y and every value at the place. Adds columns to an empty table.
void add_rows(Table& table, double time, const SampledLine& line, const std::vector<ProbeValue>& values);

/// Integrals along a line: moment, twist and shear of M_nn, M_ns and Q_n, where loads act in the plane normal_force and
/// tangential_force of N_nn and N_ns. n is to the right of the way along the line, s = n turned by +90 degrees.
std::vector<ProbeValue> sums_along(const SampledLine& line, const std::vector<ProbeValue>& values);

/// Springs between the faces of the cracks of a plate, by numbers of springs.
class SpringsOnCracks {
public:
  explicit SpringsOnCracks(const plate::Formulation& plate);

  /// Adds rows of crack_springs.csv: `time`, the spring, x, y and what it carries there. Adds columns to an empty
  /// table. Returns the integrals over every spring, as sums_along(), and the largest K of a front.
  std::vector<ProbeValue> take(const Frame& frame, Table& table) const;

private:
  std::vector<std::vector<plate::CrackSpring>> springs_;
};

}  // namespace post
