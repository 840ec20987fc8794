#pragma once
#include <string>
#include <vector>

namespace plate {
class Formulation;
}

namespace post {
struct ScenePart;
struct Summary;
}  // namespace post

namespace cases {

struct Case;

/// The parts of the program that this case uses, each with the memory that it takes. What is not listed is not there.
std::vector<post::ScenePart> scene(const Case& content, const plate::Formulation& plate);

/// What is known of a run before it.
post::Summary about(const Case& content, const plate::Formulation& plate, const std::vector<std::string>& warnings);

}  // namespace cases
