#include "cases/studies/study.hpp"

#include "post/report/quantity.hpp"
#include "tests/unit/cases/case_text.hpp"

using namespace case_text;

namespace {

std::string lack(const std::string& text, const post::Quantity& quantity,
                 const std::vector<std::string>& settings = {}) {
  const auto file = read(text, settings);
  return cases::lacking(file.content, quantity);
}

const std::string with_factors = plain + "[srif]\n";

}  // namespace

TEST_CASE("lacking: a run has the quantities that its case asks for") {
  CHECK(lack(with_factors, {"K1", 1}) == "");
  CHECK(lack(with_factors, {"K1", 2}) == "the case has 2 crack tips, counted from 0");
  CHECK(lack(with_factors, {"F1", 0}) == "the case has no srif.normalize");
  CHECK(lack(plain, {"K1", 0}) == "the case has no [srif]");
  CHECK(lack(plain, {"w", {}, "middle"}, {"output.probes={middle=[0,0.5]}"}) == "");
  CHECK(lack(plain, {"w", {}, "middle"}) == "the case has no probe \"middle\"");
}

TEST_CASE("lacking: N1, N2, u and v are of cases with loads in the plane") {
  const std::vector<std::string> pulled{"load=[{kind='edge_traction',edges=['right'],value=1}]",
                                        "support[0].in_plane=\"fixed\"", "output.probes={middle=[0,0.5]}"};
  CHECK(lack(with_factors, {"N1", 1}, pulled) == "");
  CHECK(lack(with_factors, {"u", {}, "middle"}, pulled) == "");
  CHECK(lack(with_factors, {"N1", 1}) == "the case has no loads in the plane");
  CHECK(lack(with_factors, {"v", {}, "middle"}) == "the case has no loads in the plane");
  CHECK(lack(with_factors, {"N1", 1}, {"analysis.nonlinear=true"}) == "");
}

TEST_CASE("lacking: frequencies, peaks and growth are of their analyses") {
  const std::vector<std::string> modes{"analysis={kind=\"frequencies\"}", "section.density=1", "-load"};
  CHECK(lack(plain, {"frequency"}, modes) == "");
  CHECK(lack(plain, {"frequency"}) == "the case has no frequencies");
  const std::vector<std::string> buckling{"analysis={kind=\"buckling\"}", "-load",
                                          "load=[{kind='edge_traction',edges=['right'],value=-1}]"};
  CHECK(lack(plain, {"buckling_factor"}, buckling) == "");
  CHECK(lack(plain, {"buckling_factor"}) == "the case has no buckling loads");
  CHECK(lack(plain, {"crack_length"}, buckling) == "the case has buckling loads only");
  CHECK(lack(plain, {"crack_length"}, modes) == "the case has frequencies only");
  CHECK(lack(plain, {"K1_peak", 0}) == "peaks in time are of dynamic cases without growth");
  CHECK(lack(plain, {"crack_length"}) == "the case has no [growth]");
  CHECK(lack(plain, {"largest_load_factor"}, {"growth={fracture_energy=1}"}) == "");
}
