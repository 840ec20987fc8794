#include "tests/reliability/mutated.hpp"

#include <array>
#include <random>
#include <vector>

namespace {

constexpr std::array values{"0",
                            "-0.0",
                            "1",
                            "-1",
                            "2",
                            "1e-300",
                            "5e-324",
                            "1e300",
                            "-1e300",
                            "inf",
                            "-inf",
                            "nan",
                            "1e-12",
                            "0.1",
                            "0.05",
                            "0.3",
                            "0.4999999",
                            "0.5",
                            "3",
                            "1000",
                            "1e6",
                            "true",
                            "false",
                            "\"\"",
                            "[]",
                            "{}",
                            "[0, 0]",
                            "[[]]",
                            "\"x\"",
                            "[[0, 0]]",
                            "[[0, 0], [0, 0]]",
                            "[[0, 1], [0.5, 0]]",
                            "[\"left\"]",
                            "[\"edge0\"]",
                            "\"galerkin\"",
                            "\"ordinary\"",
                            "\"dynamic\"",
                            "\"static\"",
                            "\"frequencies\"",
                            "\"clamped\"",
                            "\"pressure\"",
                            "9223372036854775807",
                            "-9223372036854775808",
                            "1979-05-27"};

/// Lines for a table that the text has, as of a load, a support or a section.
constexpr std::array lines_to_add{
    "level = 0.4",
    "path = [[-0.9, 0.5], [0.9, 0.5]]",
    "speed = 5.0",
    "expression = \"sin(pi * x) / (y - 0.5)\"",
    "expression = \"x < 0 ? 1 : exp(800 * y)\"",
    "table = \"../table/triangles.csv\"",
    "table_digest = \"0123456789abcdef\"",
    "gravity = -9.81",
    "gradient = [0.0, -1.0]",
    "from = [0.5, 1.0]",
    "on = { circle = [0.4, 0.4, 0.3] }",
    "on = { polygon = [[-0.5, -0.5], [0.5, -0.5], [0.0, 0.5]] }",
    "along = [[-0.5, 0.1], [0.5, 0.1], [0.5, 0.3]]",
    "points = [[0.3, 0.3]]",
    "position = [0.2, 0.2]",
    "support = 0",
    "slope = [0.0, 0.01]",
    "rotation = 0.01",
    "twist = 1.0",
    "tensor = [1.0, 0.5, 0.2]",
    "history = \"sine\"",
    "frequency = 2.0",
    "history = [[0.0, 0.0], [0.1, 1.0]]",
    "lifts_off = true",
    "pushes = \"up\"",
    "shear = 2.0",
    "torsion = 0.5",
    "mass = 0.1",
    "kind = \"temperature\"",
    "kind = \"settlement\"",
    "kind = \"point_force\"",
    "kind = \"pinned\"",
    "kind = \"symmetry\"",
    "method = \"lanczos\"",
    "method = \"direct\"",
    "start = \"equilibrium\"",
    "boundary = \"surface_nodes\"",
    "boundary = \"fictitious_nodes\"",
    "tip_spacing = 0.05",
    "density = 1.0",
    "thermal_expansion = 1e-4",
    "thickness_factor = \"1 + 0.2 * x\"",
    "young_factor = \"1 + x * y / 2\"",
    "regions = [{ on = { circle = [0.4, 0.4, 0.3] }, thickness = 0.2 }]",
    "orthotropic = { E1 = 1400.0, E2 = 100.0, nu12 = 0.3, G12 = 50.0, G13 = 50.0, G23 = 35.0 }",
    "plies = [{ thickness = 0.1, E1 = 140.0, E2 = 9.0, nu12 = 0.3, G12 = 5.0, G13 = 5.0, G23 = 3.0 }]"};

/// Whole tables.
constexpr std::array tables_to_add{
    "[[stiffener]]\nalong = [[-0.8, -0.5], [0.2, -0.5]]\nbending = 5.0\ntorsion = 0.5\nmass = 0.1",
    "[[stiffener]]\nedges = [\"right\"]\nbending = 5.0\nshear = 100.0",
    "[[spring]]\nedges = [\"right\"]\ndeflection = 100.0\nrotation_normal = 5.0",
    "[[spring]]\nposition = [0.3, 0.3]\ndeflection = 10.0\nrotation = 1.0",
    "[[foundation]]\nmodulus = 50.0\nlifts_off = true",
    "[[foundation]]\nmodulus = 50.0\nshear = 2.0\non = { circle = [0.0, 0.0, 0.5] }",
    "[[support]]\nkind = \"pinned\"\nalong = [[0.5, -0.8], [0.5, 0.8]]",
    "[[support]]\nkind = \"clamped\"\non = { circle = [0.0, 0.5, 0.25] }",
    "[[load]]\nkind = \"temperature\"\nvalue = 10.0",
    "[[load]]\nkind = \"settlement\"\nsupport = 0\nvalue = 0.01",
    "[[load]]\nkind = \"pressure\"\ntable = \"../table/triangles.csv\"",
    "[[load]]\nkind = \"pressure\"\nvalue = 9.81\nlevel = 0.4",
    "[[load]]\nkind = \"pressure\"\ngravity = -9.81",
    "[[load]]\nkind = \"point_force\"\nvalue = 1.0\npath = [[-0.9, 0.5], [0.9, 0.5]]\nspeed = 5.0",
    "[[load]]\nkind = \"line_load\"\nvalue = 1.0\nalong = [[-0.5, 0.4], [0.5, 0.4]]",
    "[[case]]\nname = \"a\"\n[[case.load]]\nkind = \"pressure\"\nvalue = 1.0",
    "[[case]]\nname = \"b\"\nload = [{ kind = \"settlement\", support = 0, value = 0.01 }]",
    "[[combination]]\nname = \"c\"\nof = { a = 1.35, b = -1.0 }",
    "[[section.regions]]\non = { polygon = [[-0.8, -0.8], [-0.4, -0.8], [-0.4, -0.4]] }\nyoung = 2000.0\ndensity = 3.0",
    "[growth]\nfracture_energy = 1e-3\nmax_advances = 2",
    "[srif]\nrichardson = true\ntoughness = 10.0",
    "[output]\nprobes = { p = [0.5, 0.5] }"};

class Change {
public:
  Change(std::string_view text, unsigned seed) : random_(seed) {
    while (!text.empty()) {
      const auto end = text.find('\n');
      lines_.emplace_back(text.substr(0, end));
      text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    }
    if (lines_.empty()) lines_.emplace_back();
  }

  std::string made() {
    const auto at = std::ptrdiff_t(below(lines_.size())), other = std::ptrdiff_t(below(lines_.size()));
    std::string& line = lines_[std::size_t(at)];
    switch (below(10)) {
      case 0:
        lines_.erase(lines_.begin() + at);
        break;
      case 1:
        lines_.insert(lines_.begin() + other, std::string(line));
        break;
      case 2:
        std::swap(line, lines_[std::size_t(other)]);
        break;
      case 3:
        line = line.substr(0, line.find('=')) + "= " + value();
        break;
      case 4:  // the value of another line
        if (const auto& from = lines_[std::size_t(other)]; from.find('=') != std::string::npos)
          line = line.substr(0, line.find('=')) + from.substr(from.find('='));
        break;
      case 5:  // into a table that is there, after its first line
        lines_.insert(lines_.begin() + place_in_table(at), lines_to_add[below(lines_to_add.size())]);
        break;
      case 6:
        lines_.emplace_back(tables_to_add[below(tables_to_add.size())]);
        break;
      default:
        change_number(line);
    }
    std::string text;
    for (const auto& one : lines_) text += one + "\n";
    return text;
  }

private:
  std::size_t below(std::size_t limit) { return std::uniform_int_distribution<std::size_t>(0, limit - 1)(random_); }
  /// Below the line that begins the table of a line.
  std::ptrdiff_t place_in_table(std::ptrdiff_t at) {
    while (at > 0 && !lines_[std::size_t(at)].starts_with('[')) --at;
    return at + 1;
  }
  std::string value() { return values[below(values.size())]; }

  /// One of the numbers of a line: another one, or nearly the same.
  void change_number(std::string& line) {
    constexpr const char* of_number = "0123456789.eE+-";
    std::vector<std::pair<std::size_t, std::size_t>> numbers;
    for (auto from = line.find_first_of("0123456789"); from != std::string::npos;) {
      const auto end = std::min(line.find_first_not_of(of_number, from), line.size());
      numbers.emplace_back(from, end - from);
      from = line.find_first_of("0123456789", end);
    }
    if (numbers.empty()) return;
    const auto [from, length] = numbers[below(numbers.size())];
    const auto number = line.substr(from, length);
    constexpr std::array parts{"-", "1", "0", "e9", "e-9", "99999999", "."};
    line.replace(from, length,
                 below(2) == 0   ? value()
                 : below(2) == 0 ? number + parts[below(parts.size())]
                                 : "-" + number);
  }

  std::mt19937 random_;
  std::vector<std::string> lines_;
};

}  // namespace

std::string mutated(std::string_view text, unsigned seed) {
  return Change(text, seed).made();
}
