#pragma once
#include "plate/solve/archive.hpp"
#include "post/files/frame.hpp"
#include "post/files/summary.hpp"
#include "post/files/table.hpp"

/// Serialization of what is recorded of a run (plate/solve/archive.hpp).
namespace post {

/// Archives a method by its name.
template <typename Archive>
void archive_name(Archive& archive, SrifMethod& method) {
  std::string name = name_of(method);
  archive(name);
  if constexpr (Archive::is_loading::value) method = srif_method(name).value();
}

template <typename Archive>
void serialize(Archive& archive, SecondSrif& second) {
  auto& [formulation, method, K1, K2, K3, difference, in_plane] = second;
  archive(formulation);
  archive_name(archive, method);
  archive(K1, K2, K3, difference, in_plane);
}

template <typename Archive>
void serialize(Archive& archive, Srif& srif) {
  auto& [tip, position, method, K1, K2, K3, F1, F2, F3, error, errors, accuracy, lost_shear, resolved, membrane, second,
         G, rings, fits, residual, samples] = srif;
  archive(tip, position);
  archive_name(archive, method);
  archive(K1, K2, K3, F1, F2, F3, error, errors, accuracy, lost_shear, resolved, membrane, second, G, rings, fits,
          residual, samples);
}

}  // namespace post

template <>
inline constexpr int plate::archived_members<post::Table> = 2;
template <>
inline constexpr int plate::archived_members<post::CrackLine> = 2;
template <>
inline constexpr int plate::archived_members<post::CrackTip> = 4;
template <>
inline constexpr int plate::archived_members<post::Cracks> = 2;
template <>
inline constexpr int plate::archived_members<post::MembraneFactors> = 5;
template <>
inline constexpr int plate::archived_members<post::SecondInPlane> = 2;
template <>
inline constexpr int plate::archived_members<post::RingSrif> = 6;
template <>
inline constexpr int plate::archived_members<post::FitSrif> = 5;
template <>
inline constexpr int plate::archived_members<post::Peak> = 7;
template <>
inline constexpr int plate::archived_members<post::Wrench> = 3;
template <>
inline constexpr int plate::archived_members<post::ReactionSummary::Support> = 2;
template <>
inline constexpr int plate::archived_members<post::Balance> = 4;
