#include "plate/model/supports.hpp"
#include "tests/catch.hpp"

TEST_CASE("held edges: a layer holds what the line does, a pin and a free edge hold nothing of it") {
  using enum plate::SupportKind;
  const auto holds = [](plate::SupportKind kind) {
    const auto held = plate::held_by(kind);
    return 4 * held.w + 2 * held.normal + held.tangential;
  };
  CHECK(holds(clamped) == 7);
  CHECK(holds(simply_supported) == 4);
  CHECK(holds(simply_supported_hard) == 5);
  CHECK(holds(symmetry) == 2);
  CHECK(holds(pinned) == 0);
  CHECK(holds(plate::SupportKind::free) == 0);
  for (const auto kind : {clamped, simply_supported, simply_supported_hard})
    CHECK(holds(plate::in_layer(kind)) == holds(kind));
}
