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

/// Warns where the energy spent per crack area is more than 5 % from the fracture energy: the speed of the tips is then
/// not that of a crack.
std::vector<std::string> distrust_of_spent(const Growth& growth, const Moved& moved, const plate::Section& section);

/// Tips in motion whose directions or energies are not resolved. `remedy`: Formulation::remedy().
std::vector<std::string> distrust_of_directions(const Moved& moved, const std::string& remedy);

}  // namespace fracture
