#include "post/factors/srif.hpp"
#include "post/files/frame.hpp"
#include "tests/catch.hpp"

TEST_CASE("drawn cracks: tips in the order of their numbers, with the first factors of each that are resolved") {
  using geometry::End;
  const std::vector<geometry::CrackPath> paths{{{{0, 0}, {1, 0}}, End::mouth, End::junction},
                                               {{{2, 0}, {3, 0}, {3, 1}}, End::tip, End::tip}};
  auto cracks = post::given_cracks(paths);
  REQUIRE(cracks.lines.size() == 2);
  CHECK(cracks.lines[1].advances == std::vector<double>{0, 0, 0});
  REQUIRE(cracks.tips.size() == 2);
  CHECK(cracks.tips[0].position == geometry::Point(2, 0));
  CHECK(cracks.tips[1].position == geometry::Point(3, 1));
  CHECK(cracks.tips[1].crack == 1);

  std::vector<post::Srif> factors(3);
  factors[0].tip = factors[1].tip = 1, factors[2].tip = 7;
  factors[0].K1 = 4, factors[0].K3 = 5, factors[1].K1 = 9;
  factors[0].resolved[2] = false;
  post::set_factors(cracks, factors);
  CHECK_FALSE(cracks.tips[0].factors);
  REQUIRE(cracks.tips[1].factors);
  CHECK((*cracks.tips[1].factors)[0] == 4);
  CHECK(std::isnan((*cracks.tips[1].factors)[2]));
}
