"""The fences hold: each stops what it is there to stop, in a small tree of its own, and lets the rest pass."""
import json
import pathlib
import shutil
import tempfile
import unittest
import unittest.mock

import format as formatting
import functions
import headers
import includes
import lengths
import style
import tidy
import tree
import units


class Tree(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        self.table = includes.Table(pathlib.Path(__file__).with_name("arrows.toml"))

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        return pathlib.PurePath(name)

    def wrong_includes(self, name, text):
        return list(includes.of_file(self.root, self.table, self.write(name, text)))


class Includes(Tree):
    def setUp(self):
        super().setUp()
        for name in ("geometry/shape/a.hpp", "plate/model/b.hpp", "plate/discretise.hpp", "plate/bonds/c.hpp",
                     "plate/galerkin/rows/d.hpp", "post/files/e.hpp", "cases/input/f.hpp"):
            self.write(name, "#pragma once\n")

    def test_arrows(self):
        for including, header, right in (
                ("plate/model/x.cpp", "geometry/shape/a.hpp", True), ("geometry/shape/x.cpp", "plate/model/b.hpp", False),
                ("plate/bonds/rows/x.hpp", "plate/bonds/c.hpp", True), ("plate/bonds/x.cpp", "plate/galerkin/rows/d.hpp", False),
                ("plate/galerkin/x.cpp", "plate/bonds/c.hpp", False), ("plate/model/x.cpp", "plate/bonds/c.hpp", False),
                ("plate/discretise.cpp", "plate/bonds/c.hpp", True), ("plate/bonds/x.cpp", "plate/discretise.hpp", False),
                ("cases/driver/x.cpp", "plate/discretise.hpp", True), ("cases/driver/x.cpp", "plate/bonds/c.hpp", False),
                ("post/files/x.cpp", "cases/input/f.hpp", False), ("cases/input/x.cpp", "post/files/e.hpp", True),
                ("cases/programs/serial.cpp", "cases/input/f.hpp", True), ("elsewhere/x.cpp", "geometry/shape/a.hpp", False)):
            for marks in ('"{}"', "<{}>"):
                wrong = self.wrong_includes(including, f"#include {marks.format(header)}\n")
                self.assertEqual(not wrong, right, f"{including} {header}: {wrong}")

    def test_libraries(self):
        for including, header, right in (
                ("geometry/cells/x.cpp", "CGAL/Polygon_2.h", True), ("geometry/cells/x.hpp", "CGAL/Polygon_2.h", False),
                ("plate/model/x.cpp", "CGAL/Polygon_2.h", False), ("post/files/x.cpp", "zlib.h", True),
                ("post/report/x.cpp", "zlib.h", False), ("post/files/x.hpp", "zlib.h", False), ("post/factors/x.cpp", "hdf5.h", False),
                ("cases/input/x.cpp", "toml++/toml.h", True), ("post/files/x.cpp", "toml++/toml.h", False),
                ("post/files/x.hpp", "nlohmann/json.hpp", False),
                ("plate/model/x.hpp", "Eigen/Core", True), ("plate/model/x.hpp", "vector", True),
                ("plate/model/x.cpp", "boost/any.hpp", False)):
            wrong = self.wrong_includes(including, f"// text\n#  include <{header}>\n")
            self.assertEqual(not wrong, right, f"{including} {header}: {wrong}")
            self.assertTrue(right or wrong[0].startswith(f"{including}:2: "), wrong)

    def test_what_is_no_include(self):
        self.assertEqual(self.wrong_includes("geometry/shape/x.cpp", '// #include "plate/model/b.hpp"\n/*\n#include <zlib.h>\n*/\n'), [])

    def test_paths(self):
        self.assertTrue(self.wrong_includes("plate/model/x.cpp", '#include "b.hpp"\n'))
        self.assertTrue(self.wrong_includes("plate/model/x.cpp", '#include "plate/model/none.hpp"\n'))

    def test_arrows_have_no_rings(self):
        for name, allowed in self.table.arrows.items():
            for other in allowed:
                for target in self.table.arrows:
                    if target.startswith(other) and target not in (name, "plate") and not target.startswith(name + "/"):
                        self.assertFalse(name in self.table.arrows[target], f"{name} and {target} include each other")

    def test_reach(self):
        self.write("plate/model/g.hpp", '#include "plate/model/b.hpp"\n#include "geometry/shape/a.hpp"\n')
        self.write("plate/model/g.cpp", '#include "plate/model/g.hpp"\n#include <vector>\n')
        self.assertEqual(len(includes.Reach(self.root).of(pathlib.PurePath("plate/model/g.cpp"))), 3)


SAMPLE = '''#include <x>
#define CALL(x) do { x; } while (0
namespace plate {
namespace {
constexpr double reach = 1'000.0;
const std::map<int, int> table = {{1, 2}, {3, 4}};
using Row = std::vector<int>;
struct Node {
  Node(int a) : a_{a}, b_(a) {
  }
  int sum() const { return a_ + b_; }
  int a_, b_;
};
template <typename T, class U = std::vector<int>>
T local_operator(const T& a, U b = {}) {
  const char* brace = "}{"; char c = '{'; /* { */
  auto inner = [&](int k) { return k; };  // }
  const auto raw = R"(
  }
)";
  return a;
}
}  // namespace
bool operator==(const Node& a, const Node& b) {
  return true;
}
auto free_lambda = [](int x) {
  return x;
};
}  // namespace plate
TEST_CASE("a thing { of its own", "[tag]") {
  CHECK(1);
}
'''


class Lengths(Tree):
    def test_functions(self):
        found = {function.name: (function.first, function.lines) for function in functions.Reader(SAMPLE).functions}
        self.assertEqual(found, {"Node": (9, 2), "sum": (11, 1), "local_operator": (14, 9), "operator==": (24, 3),
                                 "free_lambda": (27, 3), "TEST_CASE": (31, 3)})

    def test_names(self):
        reader = functions.Reader(SAMPLE)
        self.assertEqual(reader.names, {"reach", "table", "Row", "Node", "local_operator", "free_lambda", "TEST_CASE"})
        self.assertTrue({"sum", "b_"} <= reader.members)

    def of_length(self, lines):
        path = self.write("plate/model/long.cpp", "void f(int a,\n       int b) {\n" + "  a;\n" * (lines - 3) + "}\n")
        return list(lengths.of_file(self.root, path))

    def test_length_of_functions(self):
        self.assertEqual(self.of_length(60), [])
        self.assertEqual(self.of_length(61), ["plate/model/long.cpp:1: f has 61 lines, 60 are allowed"])

    @unittest.mock.patch.object(lengths, "TESTED", 0.75)
    def test_share_of_units_with_a_test(self):
        paths = [pathlib.PurePath(f"post/files/{name}.cpp") for name in "abcd"]
        for name in "abc":
            self.write(f"tests/unit/post/files/test_{name}.cpp", f'#include "post/files/{name}.hpp"\n')
        self.assertEqual(list(lengths.tests(self.root, paths)), [])
        (self.root / "tests/unit/post/files/test_a.cpp").unlink()
        self.assertEqual(len(list(lengths.tests(self.root, paths))), 1)


class Others(Tree):
    def test_nothing_to_look_at_is_no_pass(self):
        for fence in (includes, lengths, headers, style, formatting):
            with self.assertRaises(tree.Empty):
                fence.check(self.root)

    def test_headers_of_cases(self):
        whole = "".join(f"# {key}: some\n" for key in headers.KEYS)
        self.assertEqual(list(headers.of_file(self.root, self.write("cases/static/a.toml", whole + "\ntitle = ''\n"))), [])
        self.assertEqual(len(list(headers.of_file(self.root, self.write("cases/static/a.toml", "title = ''\n" + whole)))), 1)
        self.assertEqual(len(list(headers.of_file(self.root, self.write("cases/static/a.toml", whole.replace("cost: some", "cost:"))))), 1)

    def test_catches(self):
        path = self.write("plate/model/a.cpp", "void f() {\n  try {\n    g();\n  } catch (const E&) {  // nothing\n  }\n}\n")
        self.assertEqual(len(list(style.catches(self.root, path))), 1)
        self.assertTrue(next(style.catches(self.root, path)).startswith("plate/model/a.cpp:4: "))
        path = self.write("plate/model/a.cpp", "// catch (...) {}\nvoid f() {\n  try {\n  } catch (...) {\n    h();\n  }\n}\n")
        self.assertEqual(list(style.catches(self.root, path)), [])

    def test_docstrings(self):
        path = self.write("plate/model/a.hpp", "/// Of one rank.\nint a;\n/// The spacing.\n/// Of all.\nint b;\n/// Often.\nint c;\n")
        self.assertEqual(list(style.docstrings(self.root, path)), [1])
        path = self.write("plate/model/b.hpp", "/// The same as a.\nint b;\n/// How it goes.\nint c;\n/// The sameness.\nint d;\n")
        self.assertEqual(list(style.docstrings(self.root, path)), [1, 3])

    def test_dof_arithmetic(self):
        numbers = ("held(3 * k);", "form[3 * k + 1] = f;", "tie(3 * last() + c, {{3 * *j, 1}});", "int row = 3 * (p.body.real + s) + c;",
                   "k = dof / 3;", "c = tie->follower % 3;", "owns(held[i] / 3);", "block = &rows.block[9 * b];", "other = 6 * k + 3 - larger;")
        others = ("held(dof(k, 0));", "reach = 3 * horizon + 2;", "share = area / 3;", "next = corner[(i + 1) % 3];", "y = 3 * c * s + K;",
                  "count = unknowns_per_point * points;", "// dof / 3")
        path = self.write("plate/model/a.cpp", "\n".join(numbers + others) + "\n")
        self.assertEqual(list(style.dof_arithmetic(self.root, path)), list(range(1, len(numbers) + 1)))
        for kernel in ("plate/model/space.hpp", "plate/bonds/rows/a.hpp", "plate/galerkin/stiffness.cpp"):
            self.assertEqual(list(style.dof_arithmetic(self.root, self.write(kernel, "k = dof / 3;\n"))), [])

    def test_literal_sizes(self):
        literal = ("State result = State::Zero(3, points);", "plate::Forces(3, 0)", "State u(3, n);", "State{3, 0}", "Values<float> u(3, n);",
                   "State a(unknowns_per_point, f(n)), b(3, n);", "force.resize(3, n);", "to->setZero(3, n);",
                   "Eigen::Matrix<double, 3, Eigen::Dynamic> u;", "constexpr int unknowns = 3;", "for (int c = 0; c < 3; ++c)")
        others = ("State u = zero_state(n);", "State u(unknowns_per_point, n);", "Eigen::MatrixXd::Zero(3, n)", "moments.resize(3, n);",
                  "watched.resize(3);", "for (int i = 0; i < 3; ++i)", "constexpr int most = 3;", "std::array<double, 3> K;", "// State(3, 0)")
        text = "\n".join(literal + others) + "\n"
        self.assertEqual(list(style.literal_sizes(self.root, self.write("plate/model/a.cpp", text))), list(range(1, len(literal) + 1)))
        for path in ("plate/model/state.hpp", "plate/bonds/rows/a.hpp", "geometry/cells/a.cpp"):
            self.assertEqual(list(style.literal_sizes(self.root, self.write(path, text))), [])

    def test_spelled_keys(self):
        self.write("cases/keys.md", "| key | unit |\n|---|---|\n| `title` | - |\n| `section.young` | - |\n| `support[].kind` | - |\n| `srif.rows` | - |\n")
        spelled = ('say("set section.young = 1");', 'say("section.{} = 1");', 'say("support[{}] holds");', 'key = "support[0].kind";',
                   'say(R"(srif.rows)");')
        others = ('say("set `young` = 1");', "section.young = 1;", 'read("srif.csv");', 'say("`support {}`");', "// section.young",
                  '#include "section.young"', 'say("cross_section.young");', 'say("section.younger");')
        lines = list(range(1, len(spelled) + 1))
        for folder, found in (("plate/model", lines), ("cases/input", [])):
            path = self.write(f"{folder}/a.cpp", "\n".join(spelled + others) + "\n")
            self.assertEqual(list(style.spelled_keys(self.root, path, style.key_pattern(self.root))), found)
        self.write("cases/keys.md", "no table\n")
        with self.assertRaises(tree.Empty):
            style.key_pattern(self.root)

    def test_format(self):
        self.write(".clang-format", "BasedOnStyle: Google\n")
        for name, text, right in (("a.cpp", "int a = 1;\n", True), ("b.cpp", "int b   = 1;\nint  c;\n", False)):
            wrong = formatting.of_files(self.root, [self.write(f"post/files/{name}", text)])
            self.assertEqual(not wrong, right, wrong)

    def test_sources_in_one_text(self):
        sources = [units.Source(self.root, self.write(f"post/files/{name}.cpp", text), set()) for name, text in (
            ("a", "namespace {\nint cell() { return 1; }\n}\nint a() { return x.cell + cell(); }\n"),
            ("b", "namespace {\nint cell() { return 2; }\n}\nint b() { return cell(); }\n"),
            ("c", "namespace {\nstruct S { int cell; };\nint cell() { return s.cell; }\n}\n"))]
        groups = units.groups(sources, {})
        self.assertEqual([[source.path.stem for source in group] for group in groups], [["a", "b"], ["c"]])
        text, origin = units.joined(groups[0], units.clashes(groups[0], {}))
        self.assertIn("return x.cell + cell_of_source_0();", text)
        self.assertIn("int cell_of_source_1()", text)
        self.assertEqual(origin[text.splitlines().index("int b() { return cell_of_source_1(); }")], (sources[1].path, 4))


FAULT = "namespace {\nstruct Row { int k; };\n}\ndouble share(int all) {\n  double x = 1.0 + all / 3;\n  return x;\n}\n"


@unittest.skipUnless(shutil.which("clang-tidy"), "clang-tidy is not installed: fences.py tidy needs it, tests/run does not")
class Tidy(Tree):
    def setUp(self):
        super().setUp()
        shutil.copy(pathlib.Path(__file__).parents[2] / ".clang-tidy", self.root)
        for folder in tree.FOLDERS:
            self.write(f"{folder}/a.cpp", "namespace {\nstruct Row { double w; };\n}\n")
        self.build = self.root / "build"
        self.build.mkdir()

    def check(self, *without):
        sources = [path for path in tree.cpp(self.root) if path not in without]
        self.write("build/compile_commands.json", json.dumps([
            {"directory": str(self.build), "file": str(self.root / path),
             "command": f"c++ -O3 -include {self.build}/none/cmake_pch.hxx -I{self.root} -std=c++20 -c {path}"}
            for path in sources]))
        return tidy.check(self.root, self.build)

    def test_faults(self):
        self.assertEqual(self.check(), ([], "5 sources, 5 of them new or changed, without a fault"))
        self.assertEqual(self.check(), ([], "5 sources, 0 of them new or changed, without a fault"))
        wrong = self.write("plate/b.cpp", FAULT)  # its Row is not that of a.cpp
        for _ in range(2):  # what was not clean is read again
            problems, _ = self.check()
            self.assertEqual(len(problems), 1, problems)
            self.assertTrue(problems[0].startswith("plate/b.cpp:5: "), problems)
        self.write("plate/b.cpp", FAULT.replace("/ 3", "/ 3.0"))
        self.assertEqual(self.check(), ([], "6 sources, 1 of them new or changed, without a fault"))
        self.assertTrue(self.check(wrong)[0][0].startswith("plate/b.cpp:1: not in the compile database"))

    def test_headers_count(self):
        self.write("plate/c.hpp", "#pragma once\n")
        self.write("plate/a.cpp", '#include "plate/c.hpp"\n')
        self.assertEqual(self.check()[0], [])
        self.write("plate/c.hpp", "#pragma once\ninline double share(int all) {\n  return 1.0 + all / 3;\n}\n")
        self.assertTrue(self.check()[0][0].startswith("plate/c.hpp:3: "))

    def test_no_compile_database(self):
        with self.assertRaises(tree.Empty):
            tidy.check(self.root, self.build)


if __name__ == "__main__":
    unittest.main()
