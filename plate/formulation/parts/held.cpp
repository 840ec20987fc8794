#include "plate/formulation/parts/held.hpp"

#include <fmt/format.h>

#include "plate/formulation/parts/mechanisms.hpp"
#include "plate/formulation/parts/pieces.hpp"
#include "plate/model/ranks/ranks.hpp"

namespace plate {
namespace {

std::string free_motion(const Piece& piece) {
  return fmt::format("the piece of {} point{} about ({:g}, {:g}) can move as a rigid body in {} of 3 ways",
                     piece.points, piece.points == 1 ? "" : "s", piece.position.x(), piece.position.y(),
                     piece.free_modes);
}

std::string hanging(const LoosePart& part) {
  return fmt::format(
      "the part of {} point{} about ({:g}, {:g}) hangs by bonds along one line through ({:g}, {:g}) and "
      "can turn about it",
      part.points, part.points == 1 ? "" : "s", part.position.x(), part.position.y(), part.ligament.x(),
      part.ligament.y());
}

}  // namespace

std::vector<Refusal> loose(const Formulation& plate) {
  std::vector<Refusal> result;
  const bool whole = plate.pieces().size() == 1;
  for (const auto& piece : plate.pieces())
    if (piece.free_modes > 0)
      result.push_back({whole ? Subject::support : Subject::cracks, 0,
                        whole ? "the plate is not held: " + free_motion(piece) +
                                    "; hold an edge, or pin three points that are not on one line"
                              : "cracks cut the plate into pieces, and " + free_motion(piece)});
  if (!result.empty()) return result;
  if (ranks() && !plate.mechanisms().searched)
    result.push_back(
        {Subject::cracks, 0,
         "cracks and edges leave ligaments one row of points wide, which are hinges, and several processes "
         "cannot tell what hangs by them: take a finer spacing, or one process"});
  for (const auto& part : {plate.mechanisms().driven, plate.mechanisms().twisted})
    if (part && result.empty())
      result.push_back({Subject::cracks, 0,
                        "cracks and edges leave a ligament one row of points wide, which is a hinge: " +
                            hanging(*part) + " under the load; a finer spacing gives it two rows"});
  return result;
}

std::vector<Refusal> swinging(const Formulation& plate) {
  const auto& found = plate.mechanisms();
  const bool twists = ranks() && found.twisting > 0;  // tied by one process only
  if (!plate.held() || (found.motions == 0 && found.searched && !twists)) return {};
  return {
      {Subject::cracks, 0,
       "cracks and edges leave ligaments one row of points wide, which are hinges: what hangs by them would have the "
       "frequency 0; a finer spacing gives them two rows"}};
}

std::vector<std::string> distrust_of_mechanisms(const Formulation& plate) {
  const auto& found = plate.mechanisms();
  std::vector<std::string> warnings;
  if (found.twisting > 0)
    warnings.push_back(
        fmt::format("{} point{} bonds along one line only, in ligaments one row of points wide: the "
                    "rotation about that line has no stiffness and follows the next point",
                    found.twisting, found.twisting == 1 ? " has" : "s have"));
  if (found.motions > 0)
    warnings.push_back(fmt::format("parts that hang by bonds along one line can move in {} way{} without resistance{}",
                                   found.motions, found.motions == 1 ? "" : "s",
                                   found.driven ? ": " + hanging(*found.driven) : "; no load does so"));
  if (!found.searched && !ranks())
    warnings.push_back(
        fmt::format("bonds along one line divide the plate into {} parts, too many to look for motions "
                    "without resistance",
                    found.parts));
  return warnings;
}

}  // namespace plate
