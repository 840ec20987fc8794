#pragma once
#include "fracture/growth/bond_cracks.hpp"
#include "fracture/growth/moving_cracks.hpp"
#include "fracture/growth/record.hpp"
#include "post/files/archive.hpp"

/// Serialization of growing cracks (plate/solve/archive.hpp).
namespace geometry {

template <typename Archive>
void serialize(Archive& archive, CrackPath& path) {
  auto& [vertices, front, back] = path;
  archive(vertices, front, back);
}

template <typename Archive>
void serialize(Archive& archive, Tip& tip) {
  auto& [position, direction, crack, at_back] = tip;
  archive(position, direction, crack, at_back);
}

template <typename Archive>
void serialize(Archive& archive, Obstacle& obstacle) {
  auto& [distance, position, name, crack] = obstacle;
  archive(distance, position, name, crack);
}

template <typename Archive>
void serialize(Archive& archive, GraphLine& line) {
  auto& [vertices, times, front, back, length] = line;
  archive(vertices, times, front, back, length);
}

}  // namespace geometry

namespace fracture {

template <typename Archive>
void serialize(Archive& archive, TipAdvance& advance) {
  auto& [to, length, reached] = advance;
  archive(to, length, reached);
}

template <typename Archive>
void serialize(Archive& archive, Piece& piece) {
  auto& [begin, end, crack, at_back, from, to, spent, reached, tip, tips] = piece;
  archive(begin, end, crack, at_back, from, to, spent, reached, tip, tips);
}

template <typename Archive>
void serialize(Archive& archive, StoppedTip& stopped) {
  auto& [time, tip, position, asked, error, spent] = stopped;
  archive(time, tip, position, asked, error, spent);
}

template <typename Archive>
void serialize(Archive& archive, LoadedBond& one) {
  auto& [bond, demand] = one;
  archive(bond, demand);
}

template <typename Archive>
void serialize(Archive& archive, BondTip& tip) {
  auto& [number, place, speed, way] = tip;
  archive(number, place, speed, way);
}

template <typename Archive>
void serialize(Archive& archive, Record& record) {
  auto& [growth, tips, cracks, in_motion] = record;
  archive(growth, tips, cracks, in_motion);
}

}  // namespace fracture
