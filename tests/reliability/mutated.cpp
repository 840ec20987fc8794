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
    switch (below(8)) {
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
      default:
        change_number(line);
    }
    std::string text;
    for (const auto& one : lines_) text += one + "\n";
    return text;
  }

private:
  std::size_t below(std::size_t limit) { return std::uniform_int_distribution<std::size_t>(0, limit - 1)(random_); }
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
