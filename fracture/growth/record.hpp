#pragma once
#include <optional>

#include "fracture/growth/quasi_static/load.hpp"
#include "post/files/table.hpp"
#include "post/files/vtk/crack_lines.hpp"

namespace plate {
struct Problem;
}

namespace fracture {

/// A row of growth.csv: one advance, whatever grew. What does not exist in a growth stays empty.
struct GrowthRow {
  double advance = 0;
  std::optional<double> time = {};                                                                    // in motion
  std::optional<double> load_factor = {}, displacement = {}, critical_load_factor = {}, stable = {};  // quasi-static
  double crack_length = 0;  // of all cracks [length]
  std::size_t tips = 0;
  std::optional<double> broken_bonds = {};
  std::optional<double> external_work = {}, strain_energy = {};
  double fracture_energy = 0;
  std::optional<double> released_energy = {};
  std::optional<double> critical_load_factor_error = {};  // quasi-static by tips: estimated, relative
};

/// A row of tips.csv: a tip at an advance.
struct TipRow {
  double advance = 0;
  std::optional<double> time = {};
  double tip = 0;  // its number
  std::optional<double> crack = {};
  double x = 0, y = 0, angle = 0;                                       // where it is and points to [length, degrees]
  std::optional<double> length = {};                                    // of its crack [length]
  std::optional<double> moves = {}, G = {}, K1 = {}, K2 = {}, K3 = {};  // quasi-static
  std::optional<double> begin = {}, piece = {}, speed = {},
                        spent = {};  // in motion: of the piece of crack that it has gone
  std::string reached = {};          // an edge, a hole or a crack
};

/// What a growth leaves behind: growth.csv, tips.csv, cracks.csv and cracks.vtp.
struct Record {
  Record();
  void add(const GrowthRow& row);
  void add(const TipRow& row);

  post::Table growth, tips;
  post::Cracks cracks;  // with the advance, or in motion the time, at which every vertex was reached
  bool in_motion = false;

  /// The vertices of all cracks.
  post::Table crack_table() const;
  /// Where cracks run through a place at which something presses or holds the plate.
  std::vector<std::string> cut_places(const plate::Problem& problem) const;
};

}  // namespace fracture
