#pragma once
#include <vector>

namespace plate {
class Formulation;
struct Analysis;
}  // namespace plate

namespace post {

struct ScenePart;
struct Summary;

/// What a run gives beside its solution.
struct Given {
  bool factors = false, fields = false;  // intensity factors, fields for ParaView
};

/// The parts of the program that a run uses, each with the memory that it takes. What is not listed is not there.
std::vector<ScenePart> scene(const plate::Formulation& plate, const plate::Analysis& analysis, const Given& given);

/// What is known of a run before it, without title and warnings.
Summary about(const plate::Formulation& plate, const plate::Analysis& analysis, const Given& given);

}  // namespace post
