#include "fracture/growth/growth.hpp"

#include <set>

#include "tests/catch.hpp"

using fracture::End;

TEST_CASE("words: every end of a growth has its own") {
  for (const bool by_bonds : {false, true}) {
    std::set<std::string> said;
    for (const auto end : {End::no_tip_left, End::cannot_grow, End::no_growth, End::arrested, End::most_advances,
                           End::longest, End::unstable, End::not_resolved, End::split, End::failed})
      said.insert(fracture::in_words({end, "why"}, by_bonds));
    CHECK(said.size() == 10);
    CHECK_FALSE(said.contains(""));
  }
  CHECK(fracture::in_words({End::split, "a piece is not held"}, false) == "the plate split: a piece is not held");
}

TEST_CASE("words: what became of a motion") {
  fracture::MovingGrowthOutcome moved;
  CHECK(fracture::in_words(moved) == "no growth");
  moved.under_way = 2;
  CHECK(fracture::in_words(moved) == "2 pieces of crack have begun, none has ended");
  moved.advances = 3, moved.reached = {"'left'", "crack 1"};
  CHECK(fracture::in_words(moved) == "3 pieces of crack, 'left', crack 1 reached");
  moved.stopped = {"tip 1 would turn"};
  CHECK(fracture::in_words(moved) ==
        "3 pieces of crack, 'left', crack 1 reached; stopped: not resolved: tip 1 would turn");
  moved.unsteady = {"tip 0 took 2 times"};
  CHECK_THAT(in_words(moved), Catch::EndsWith("; stopped: not resolved: tip 0 took 2 times"));
  moved = {};
  moved.broken = 7, moved.parts = 2;
  CHECK(fracture::in_words(moved) == "7 bonds broken; the plate split in 2 parts, which move on");
  moved.frozen = true;
  CHECK(fracture::in_words(moved) == "7 bonds broken; the plate split in 2 parts");
}
