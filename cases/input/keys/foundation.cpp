#include "cases/input/keys.hpp"
#include "plate/model/elastic/elastic_supports.hpp"

namespace cases {

Fields<plate::Foundation> foundation_fields() {
  using F = plate::Foundation;
  return {
      number<F>("modulus", "force/length^3", &F::modulus, positive, "what w is answered with (Winkler)").required(),
      number<F>("shear", "force/length", &F::shear, {0}, "the shear layer on top of it (Pasternak)"),
      table<F, geometry::Hole>("on", Layout::inline_, &F::patch,
                               hole_fields("the disc that lies on the foundation, without it the plate",
                                           "the polygon that lies on the foundation, without it the plate"),
                               check_hole),
  };
}

}  // namespace cases
