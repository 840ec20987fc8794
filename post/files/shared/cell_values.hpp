#pragma once
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "geometry/lattice/cloud.hpp"

namespace post {

/// Numbers of the points of one process, by the cells of the lattice in which they are.
struct CellValues {
  std::size_t width = 0;              // numbers of a point
  std::vector<geometry::Cell> cells;  // [points]
  std::vector<double> values;         // [points x width], point by point
};

/// Writes a file that is whole and on the disk, or not there, and returns its checksum. Throws
/// std::filesystem::filesystem_error.
std::string write_cells(const std::filesystem::path& path, const CellValues& values);

/// The checksum of a file; empty where it cannot be read.
std::string checksum_of(const std::filesystem::path& path);

/// Visits the points of a file one by one without holding them, where it has any of `wanted`. Returns the numbers of
/// each point. Throws std::runtime_error where it is none of these files.
std::size_t read_cells(const std::filesystem::path& path, const geometry::CellBox& wanted,
                       const std::function<void(const geometry::Cell& cell, std::span<const double> values)>& visit);

}  // namespace post
