#pragma once
#include <map>
#include <mutex>
#include <vector>

#include "plate/model/numerical_method.hpp"
#include "plate/model/problem.hpp"
#include "tests/unit/plate/model/thread_ranks.hpp"

/// Plates that threads share as processes do, against those of one.
namespace parts {

using namespace plate;

Problem problem_of(geometry::Outline outline, std::vector<Support> supports, std::vector<Load> loads);
Load pressure(double value);

/// What processes find, each with its communicator, and put together one after the other.
template <typename Find, typename Put>
void together(int processes, const Find& find, const Put& put) {
  std::mutex one_by_one;
  thread_ranks::run(processes, [&](const Communicator& all) {
    auto part = find(all);
    const std::lock_guard guard(one_by_one);
    put(part, all.rank() == 0);
  });
}

/// With formulas of its own: each is evaluated by one thread at a time.
Problem own(Problem problem);

/// Settings of a motion of a plate, beside its problem.
struct How {
  bool mixed = false;
  Damping damping = {};
  std::size_t steps = 30;
  std::vector<int> processes = {4, 7};  // beside one
};

/// Of a mass that hits: its place, velocity and force, and for how long it has touched.
using ContactForces = std::vector<std::array<double, 4>>;

/// In steps: 1 process against the ordinary program, other numbers against 1, bit for bit. Returns what hits in
/// every tenth step.
ContactForces check(const Problem& problem, const How& how = {});

/// At rest: 1 process against the ordinary program, other numbers against 1. `bound`: of how far apart these are, over
/// the largest; 0: the same bits.
void check_rest(const Problem& problem, StaticMethod method, Preconditioning wanted, double bound,
                const std::vector<int>& processes = {4});

}  // namespace parts
