#pragma once
#include "plate/solve/archive.hpp"
#include "post/files/frame.hpp"
#include "post/files/summary.hpp"
#include "post/files/table.hpp"

/// Serialization of what is recorded of a run (plate/solve/archive.hpp).
namespace post {

template <typename Archive>
void serialize(Archive& archive, Table& table) {
  auto& [columns, rows] = table;
  archive(columns, rows);
}

template <typename Archive>
void serialize(Archive& archive, CrackLine& line) {
  auto& [vertices, advances] = line;
  archive(vertices, advances);
}

template <typename Archive>
void serialize(Archive& archive, CrackTip& tip) {
  auto& [number, crack, position, factors] = tip;
  archive(number, crack, position, factors);
}

template <typename Archive>
void serialize(Archive& archive, Cracks& cracks) {
  auto& [lines, tips] = cracks;
  archive(lines, tips);
}

template <typename Archive>
void serialize(Archive& archive, RingSrif& ring) {
  auto& [inner, outer, G, K1, K2, K3] = ring;
  archive(inner, outer, G, K1, K2, K3);
}

template <typename Archive>
void serialize(Archive& archive, FitSrif& fit) {
  auto& [inner, outer, K1, K2, K3] = fit;
  archive(inner, outer, K1, K2, K3);
}

/// Archives a method by its name.
template <typename Archive>
void archive_name(Archive& archive, SrifMethod& method) {
  std::string name = name_of(method);
  archive(name);
  method = srif_method(name).value();
}

template <typename Archive>
void serialize(Archive& archive, SecondSrif& second) {
  auto& [formulation, method, K1, K2, K3, difference] = second;
  archive(formulation);
  archive_name(archive, method);
  archive(K1, K2, K3, difference);
}

template <typename Archive>
void serialize(Archive& archive, Srif& srif) {
  auto& [tip, position, method, K1, K2, K3, F1, F2, F3, error, errors, accuracy, lost_shear, resolved, second, G, rings,
         fits, residual, samples] = srif;
  archive(tip, position);
  archive_name(archive, method);
  archive(K1, K2, K3, F1, F2, F3, error, errors, accuracy, lost_shear, resolved, second, G, rings, fits, residual,
          samples);
}

template <typename Archive>
void serialize(Archive& archive, Peak& peak) {
  auto& [quantity, tip, value, time, position, outside] = peak;
  archive(quantity, tip, value, time, position, outside);
}

template <typename Archive>
void serialize(Archive& archive, Wrench& wrench) {
  auto& [force, moment_x, moment_y] = wrench;
  archive(force, moment_x, moment_y);
}

template <typename Archive>
void serialize(Archive& archive, ReactionSummary::Support& support) {
  auto& [name, position] = support;
  archive(name, position);
}

template <typename Archive>
void serialize(Archive& archive, Balance& balance) {
  auto& [supports, loads, inertia, residual] = balance;
  archive(supports, loads, inertia, residual);
}

}  // namespace post
