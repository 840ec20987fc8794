#pragma once
#include "fracture/growth/bond_cracks.hpp"
#include "fracture/growth/moving_cracks.hpp"
#include "post/files/archive.hpp"

// Serialization of growing cracks (plate/solve/archive.hpp).

template <>
inline constexpr int plate::archived_members<geometry::CrackPath> = 3;
template <>
inline constexpr int plate::archived_members<geometry::Tip> = 4;
template <>
inline constexpr int plate::archived_members<geometry::Obstacle> = 4;
template <>
inline constexpr int plate::archived_members<geometry::GraphLine> = 5;
template <>
inline constexpr int plate::archived_members<fracture::TipAdvance> = 3;
template <>
inline constexpr int plate::archived_members<fracture::Piece> = 10;
template <>
inline constexpr int plate::archived_members<fracture::StoppedTip> = 6;
template <>
inline constexpr int plate::archived_members<fracture::LoadedBond> = 2;
template <>
inline constexpr int plate::archived_members<fracture::BondTip> = 4;
