#include "tests/unit/cases/studies.hpp"

using namespace studies;

TEST_CASE("a label that is a number may be given as a number") {
  const Studies studies;
  const auto study = studies.read("case = \"a.toml\"\n" + short_axis("E", "section.young", "[10, 20.5]") +
                                  reference("quantity = \"K1\"\ntip = 0\nwhere = { E = 20.5 }\nvalue = 3"));
  CHECK_FALSE(study.runs[0].wanted[0].reference);
  CHECK(study.runs[1].wanted[0].reference);
}

TEST_CASE("what is wrong with an axis of a key is told where it stands") {
  const Studies studies;
  expect(studies.problems("case = \"a.toml\"\n" + short_axis("a", "section.poisson", "[0.1, 0.7]") +
                          short_axis("b", "section.yung", "[1.0]")),
         {"study.toml:5 section.poisson: 0.7 given", "study.toml:9 section.yung: unknown key 'yung'"});
  expect(studies.problems("case = \"a.toml\"\n" + short_axis("a", "section.young", "[1.0, 1]") +
                          short_axis("b", "section.young", "3") + short_axis("c", "section.young", "[]") +
                          "[[axis]]\nname = \"d\"\nkey = \"section.young\"\n" +
                          "[[axis]]\nname = \"e\"\nvalues = [1, 2]\n" + short_axis("f", "section.young", "[1]") +
                          "[[axis.point]]\nlabel = \"x\"\n"),
         {"study.toml:5 axis[0].values[1]: \"1\" is given twice", "study.toml:9 axis[1].values: 3 given",
          "study.toml:13 axis[2].values: [] given, must be a list of values of the key",
          "study.toml:14 axis[3].values: is missing", "study.toml:19 axis[4].values: is used with key",
          "study.toml:24 axis[5].point: is used with no key"});
}

TEST_CASE("a reference is a number, the finest run or a curve, and one of them") {
  const Studies studies;
  studies.write("curve.csv", "t,w,none\n0,0,0\n1,2,0\n");
  studies.write("one.csv", "t,w\n0,1\n");
  studies.write("radii.csv", "r,w\n0,1\n1,2\n");
  const std::string w = "quantity = \"w\"\nprobe = \"far\"\nwhere = { k = \"1\" }\n";
  studies.write("c.toml", dynamic_case());
  const std::string axes = "case = \"c.toml\"\n" + short_axis("k", "section.young", "[1, 2, 3, 4, 5, 6, 7, 8, 9]");
  const auto problem = [&](const std::string& lines) { return studies.problems(axes + reference(w + lines)); };
  expect(problem(""), {"study.toml:6 reference[0].value: is missing, must be a number; or give finest = true"});
  expect(problem("value = 1\nfinest = true"), {"study.toml:6 reference[0]: value and finest given"});
  expect(problem("finest = false"), {"study.toml:10 reference[0].finest: false given, must be true"});
  expect(problem("finest = 1"), {"study.toml:10 reference[0].finest: 1 given, must be true or false"});
  expect(problem("finest = true"), {"reference[0].finest: no axis changes the spacing"});
  expect(problem("value = 1\ncolumn = \"w\""), {"study.toml:11 reference[0].column: is used with"});
  expect(problem("value = 1\nmethod = \"x\""), {"study.toml:11 reference[0].method: is used with"});
  expect(problem("curve = \"curve.csv\""), {"reference[0].column: is missing"});
  expect(problem("curve = \"cuve.csv\"\ncolumn = \"w\""), {"study.toml:10 reference[0].curve: no such file"});
  expect(problem("curve = \"curve.csv\"\ncolumn = \"v\""),
         {"study.toml:11 reference[0].column: \"v\" given, must be one of \"t\", \"w\", \"none\""});
  expect(problem("curve = \"curve.csv\"\ncolumn = \"none\""), {"study.toml:11 reference[0].column: the curve must"});
  expect(problem("curve = \"one.csv\"\ncolumn = \"w\""), {"study.toml:11 reference[0].column: the curve must"});
  expect(problem("curve = \"radii.csv\"\ncolumn = \"w\""),
         {"study.toml:10 reference[0].curve: the file has no column"});
  CHECK(problem("curve = \"curve.csv\"\ncolumn = \"w\"").empty());
  studies.write("c.toml", cracked + "far = [0.9, 0.0]\n");
  expect(problem("curve = \"curve.csv\"\ncolumn = \"w\""), {"study.toml:6 reference[0]: the case is static"});
}
