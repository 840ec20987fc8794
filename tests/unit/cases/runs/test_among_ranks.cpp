#include "cases/runs/distributed_run.hpp"

#include <mutex>

#include "cases/driver/run.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/formulation/constraints.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/formulation/formulation.hpp"
#include "post/files/results_in_memory.hpp"
#include "post/files/summary.hpp"
#include "post/report/reactions.hpp"
#include "tests/catch.hpp"
#include "tests/unit/cases/case_text.hpp"
#include "tests/unit/plate/model/thread_ranks.hpp"

using namespace case_text;

namespace {

std::vector<std::string> refused(std::vector<std::string> overrides) {
  overrides.insert(overrides.begin(), {"discretization.formulation=ordinary", "section.density=1"});
  std::vector<std::string> keys;
  for (const auto& problem : problems(plain, overrides, true)) keys.push_back(problem.key);
  if (!keys.empty()) return keys;
  for (const auto& one : cases::errors_in_distribution(read(plain, overrides).content)) keys.push_back(one.key);
  return keys;
}

}  // namespace

TEST_CASE("what processes cannot run: motions are not in it, however they begin, are hit, damped and driven") {
  const std::string motion = "analysis={kind=\"dynamic\",duration=1,damping={ratio=[0.1,0.1],frequencies=[1,5]}}";
  CHECK(refused({motion, "initial.deflection=0.1*(x+1)^2", "initial.velocity=x",
                 "impact={position=[0.5,0.3],mass=1,velocity=2,stiffness=9}",
                 "load[1]={kind=\"point_force\",value=1,path=[[0.5,0.5],[-0.5,0.5]],speed=1}"})
            .empty());
  const std::string driven = "analysis={kind=\"dynamic\",duration=1}";
  CHECK(refused({driven, "load[1]={kind=\"settlement\",value=1,support=0,history=[[0,0],[1,1]]}"}).empty());
  const std::string lifts = "foundation=[{modulus=1,lifts_off=true}]";
  CHECK(refused({driven, lifts}).empty());
  CHECK(refused({lifts}).empty());
  CHECK(refused({"discretization.formulation=galerkin"}).empty());
}

TEST_CASE("what processes cannot run: a factor of a million points and more, vectors of Lanczos") {
  using Keys = std::vector<std::string>;
  CHECK(refused({"analysis.method=direct"}).empty());
  CHECK(refused({"analysis.method=direct", "discretization.spacing=0.0005"}) == Keys{"analysis.method"});
  CHECK(refused({"discretization.spacing=0.0005"}).empty());
  CHECK(refused({"cracks={contact=true}"}).empty());
  CHECK(refused({"cracks={contact=true}", "discretization.spacing=0.0005"}) == Keys{"cracks.contact"});
  CHECK(refused({"cracks={contact=true}", "analysis={kind=\"dynamic\",duration=1}"}).empty());
  CHECK(refused({"discretization.formulation=galerkin", "analysis={kind=\"dynamic\",duration=1,method=\"lanczos\"}"}) ==
        Keys{"analysis.method"});
}

TEST_CASE("the share of the soil that touches is the same for any number of processes") {
  const auto file = read(plain, {"discretization.formulation=ordinary", "discretization.spacing=0.02",
                                 "foundation=[{modulus=1,lifts_off=true},{modulus=2,on={circle=[0.1,0.2,0.4]}}]"});
  const auto share = [&](const plate::Communicator& all) {
    const auto plate = plate::discretise(file.content, all).plate;
    plate::State state = plate::State::Zero(3, Eigen::Index(plate->points()));
    for (std::size_t k = 0; k < plate->cloud().plate_points; ++k)
      state(0, Eigen::Index(k)) = plate->cloud().positions[k].y() - 0.3;
    return plate->boundary().elastic_supports.contact_share(state, plate->boundary().map);
  };
  const double whole = share(plate::single_process());
  std::vector<double> found;
  for (const int processes : {1, 3})
    thread_ranks::run(processes, [&](const plate::Communicator& all) {
      const double own = share(all);
      static std::mutex one_by_one;
      const std::lock_guard guard(one_by_one);
      found.push_back(own);
    });
  CHECK(std::ranges::count(found, found.front()) == 4);
  CHECK(found.front() == Approx(0.65).epsilon(1e-13));
  CHECK(found.front() == Approx(whole).epsilon(2e-11));  // 1.6e5 terms one by one: each errs by 2^-53 at most
}

TEST_CASE("linear theory is judged in a plate that processes share as in the whole one") {
  const auto file = read(plain, {"discretization.formulation=ordinary", "discretization.spacing=0.1",
                                 "load[0].value=0.001", "output.fields=[]"});
  const auto off = [&](const plate::Communicator& all) {
    post::ResultsInMemory kept;
    kept.wants_fields = false;
    return cases::run(file, {{}, true, &kept, false, &all}).linear_theory_off;
  };
  const auto whole = off(plate::single_process());
  REQUIRE(whole);
  std::vector<std::optional<double>> found;
  thread_ranks::run(2, [&](const plate::Communicator& all) {
    const auto own = off(all);
    static std::mutex one_by_one;
    const std::lock_guard guard(one_by_one);
    found.push_back(own);
  });
  for (const auto& one : found) {
    REQUIRE(one);
    CHECK(*one == Approx(*whole).epsilon(1e-3));
  }
}

TEST_CASE("reactions along edges are the same for any number of processes") {
  for (const std::string formulation : {"ordinary", "galerkin"}) {
    const auto file = read(plain, {"discretization.formulation=" + formulation, "discretization.spacing=0.02",
                                   "support=[{kind=\"simply_supported_hard\",edges=[\"left\",\"bottom\",\"top\"]}]"});
    const auto along = [&](const plate::Communicator& all) {
      const auto plate = plate::discretise(file.content, all).plate;
      plate::State state = plate::zero_state(plate->points());
      for (Eigen::Index k = 0; k < state.cols(); ++k) {
        const auto& x = plate->cloud().positions[std::size_t(k)];
        state.col(k) << x.x() * x.x() * x.y(), x.x() - x.y(), x.x() * x.y();
      }
      plate::Forces internal;
      plate->internal_force(state, internal);
      const post::Supports supports(plate->boundary());
      const auto reaction = supports.reaction(plate->constraints().on_held(internal), supports.nothing(), nullptr);
      const auto found = supports.along_edges(reaction, 12, 0.1);
      std::vector<double> values;
      for (const auto& curve : found.curves)
        for (const auto& one : curve.values)
          values.insert(values.end(), {one.s, one.force, one.moment, one.twist, one.kirchhoff_force});
      for (const auto& corner : found.corners) values.push_back(corner.force);
      return values;
    };
    const auto whole = along(plate::single_process());
    CAPTURE(formulation);
    REQUIRE(whole.size() == 3 * 12 * 5 + 4);
    double size = 0;
    for (const double one : whole) size = std::max(size, std::abs(one));
    std::vector<std::vector<double>> found;
    thread_ranks::run(3, [&](const plate::Communicator& all) {
      auto own = along(all);
      static std::mutex one_by_one;
      const std::lock_guard guard(one_by_one);
      found.push_back(std::move(own));
    });
    REQUIRE(found.size() == 3);
    for (const auto& own : found) {
      REQUIRE(own.size() == whole.size());
      for (std::size_t i = 0; i < own.size(); ++i)
        CHECK(std::abs(own[i] - whole[i]) < 1e-10 * size);  // measured: below 1e-13
    }
  }
}
