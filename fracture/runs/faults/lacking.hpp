#pragma once
#include <string>

namespace post {
struct Quantity;
}

namespace fracture {

struct RunPlan;

/// Why a run has no such quantity; empty where it has.
std::string lacking(const RunPlan& plan, const post::Quantity& quantity);

}  // namespace fracture
