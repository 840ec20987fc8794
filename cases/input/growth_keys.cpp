#include "cases/input/keys.hpp"
#include "fracture/growth/growth.hpp"

namespace cases {
namespace {

using fracture::Growth;

const Words<Growth::Criterion> criteria{{{"energy_release", Growth::Criterion::energy_release},
                                         {"bond_energy", Growth::Criterion::bond_energy},
                                         {"curvature_shear", Growth::Criterion::curvature_shear}}};

const Words<Growth::Direction> directions{{{"tangential_moment", Growth::Direction::tangential_moment},
                                           {"energy_release", Growth::Direction::energy_release},
                                           {"straight", Growth::Direction::straight}}};

const Words<Growth::Control> controls{{{"load", Growth::Control::load},
                                       {"displacement", Growth::Control::displacement},
                                       {"equilibrium", Growth::Control::equilibrium}}};

Field<Growth> no_fail() {
  const std::string form = "[[xmin, ymin, xmax, ymax], ...]";
  return value<Growth>(
      {"no_fail", "length", form, "", "rectangles in which tips stay where they are, and bonds hold"},
      [form](const Value& given, Growth& growth) {
        for (const auto& box : given.elements(form))
          if (const auto sides = box_of(box)) growth.no_fail.push_back(*sides);
      },
      [](const Growth& growth) {
        std::vector<std::string> boxes;
        for (const auto& box : growth.no_fail) boxes.push_back(text_of_numbers(box));
        return boxes.empty() ? "" : fmt::format("[{}]", fmt::join(boxes, ", "));
      });
}

const Words<Growth::Unstable> unstables{
    {{"jump", Growth::Unstable::jump}, {"stop", Growth::Unstable::stop}, {"move", Growth::Unstable::move}}};

const Words<Growth::Detached> detached_words{{{"move", Growth::Detached::move}, {"freeze", Growth::Detached::freeze}}};

/// A key of tips is not written where bonds break one by one.
Field<Growth> of_tips(Field<Growth> field) {
  field.write = [write = field.write](const Growth& growth, Analysis::Kind kind) {
    return growth.by_bonds() ? std::string() : write(growth, kind);
  };
  return field;
}

}  // namespace

Fields<Growth> growth_fields() {
  using G = Growth;
  return {
      choice<G, G::Criterion>(
          "criterion", &G::criterion, criteria,
          "when a crack grows: energy_release: its tip's energy release rate reaches the fracture energy; "
          "bond_energy, curvature_shear: bonds break one by one, where they bear no more"),
      number<G>("fracture_energy", "force/length", &G::fracture_energy, positive,
                "energy per area of crack; may be absent where critical_curvature or critical_shear is given"),
      number<G>("apparent_toughness", "-", &G::apparent_toughness, positive,
                "of a criterion for bonds, over fracture_energy: the limits are divided by it; absent: as measured"),
      number<G>("critical_curvature", "1/length", &G::critical_curvature, positive,
                "curvature_shear: limit of the curvature of bonds; absent: from fracture_energy"),
      number<G>("critical_shear", "-", &G::critical_shear, positive,
                "curvature_shear: limit of the shear angle of bonds; absent: from fracture_energy"),
      of_tips(choice<G, G::Direction>(
          "direction", &G::direction, directions,
          "where a tip turns to: largest moment across the crack (K2 = 0), largest energy release, or on")),
      choice<G, G::Control>(
          "control", &G::control, controls,
          "what is held while a crack runs: the loads, the displacement that they do work on, or neither: "
          "the load follows the crack")
          .in({Analysis::Kind::static_}),
      choice<G, G::Unstable>(
          "unstable", &G::unstable, unstables,
          "an advance for which the load is more than enough: jump on to where the crack rests again, stop, or "
          "(tips and bonds over a horizon) stop and go on in motion")
          .in({Analysis::Kind::static_}),
      number<G>("duration", "time", &G::duration, positive, "simulated time of the motion of unstable = move")
          .in({Analysis::Kind::static_}),
      choice<G, G::Detached>("fallen", &G::detached, detached_words,
                             "pieces that no support holds any more: move on, or stay where they are")
          .in({Analysis::Kind::dynamic}),
      of_tips(number<G>("increment", "-", &G::increment, {0.5, 20},
                        "advance of a tip, in spacings; five at least after a turn")),
      number<G>("max_advances", "-", &G::max_advances, {1, 1000000},
                "the growth ends after so many (bonds in motion: steps in which any broke)"),
      number<G>("max_length", "length", &G::max_length, positive,
                "the growth ends when a crack is so long (bonds: all together)"),
      boolean<G>("tension_only", &G::tension_only,
                 "tips that close on the z > 0 face (K1 < 0) stay, bonds that do so hold"),
      no_fail(),
      number<G>("frames_every", "-", &G::frames_every, {1, 1000000},
                "advances between frames for ParaView; the first and the last state are always written")
          .in({Analysis::Kind::static_}),
  };
}

}  // namespace cases
