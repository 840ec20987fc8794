#include "cases/runs/quasi_static_run.hpp"

#include "geometry/shape/crack_path.hpp"
#include "post/files/sinks.hpp"
#include "tests/unit/cases/case_text.hpp"

using namespace case_text;

TEST_CASE("quasi-static run: without factors of its own, those that give the energy release rate") {
  const auto standard = cases::factors_of_growth({});
  CHECK(standard.methods ==
        std::vector<post::SrifMethod>{post::SrifMethod::virtual_crack_extension, post::SrifMethod::domain_integral});
  post::SrifOptions asked;
  asked.methods = {post::SrifMethod::domain_integral};
  CHECK(cases::factors_of_growth(asked).methods == asked.methods);
}

TEST_CASE("quasi-static run: a row for every advance, longer cracks in the end") {
  const auto file = read(plain, {"growth={fracture_energy=1,max_advances=1}"});
  post::ResultsInMemory in_memory;
  cases::QuasiStaticRun run({file.content, {{}, true, &in_memory}}, plate::discretise(file.content));
  const auto summary = run({std::make_unique<post::MemorySink>(in_memory), "", ""}, nullptr);
  REQUIRE(summary.growth);
  CHECK(summary.growth->advances == 1);
  CHECK(geometry::length(run.cracks().front()) > 0.6);
  for (const auto& [name, table] : in_memory.tables)
    if (name == "growth" || name == "history") CHECK(table.rows.size() == 2);
}
