#pragma once
#include "plate/model/state.hpp"
#include "post/files/shared/cell_values.hpp"

namespace plate {
struct Boundary;
}

namespace fracture {

/// Of the points that no other process has, the columns of some states side by side. One that is empty is left out.
post::CellValues own_values(const plate::Boundary& boundary, const std::vector<const plate::State*>& states);

/// Gives own points their columns of the states from files of any number of processes (post::write_cells), all others
/// zeros; those states that were empty stay so. Throws std::runtime_error where a point is in none of the files.
void put_values(const plate::Boundary& boundary, const std::vector<std::filesystem::path>& files,
                const std::vector<plate::State*>& states);

}  // namespace fracture
