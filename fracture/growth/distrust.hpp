#pragma once
#include <string>
#include <vector>

namespace plate {
class Formulation;
struct Section;
}  // namespace plate

namespace fracture {

struct Growth;
struct Moved;

/// What of a growth by bonds is not to be trusted at this discretisation: what the apparent toughness was not measured
/// for, and what bonds cannot do. Nothing of a growth by tips.
std::vector<std::string> distrust_of_bonds(const Growth& growth, const plate::Formulation& plate);

/// Tips that have too little about them for the energy release rate, which growth by tips needs, and why.
std::vector<std::string> tips_without_rings(const plate::Formulation& plate);

/// What tips that ran took where that is far from the fracture energy, whose speed is then not that of a crack.
std::vector<std::string> distrust_of_spent(const Growth& growth, const Moved& moved, const plate::Section& section);

}  // namespace fracture
