#include "plate/model/wording.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

namespace plate {
namespace {

std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// Edit distance with neighbours exchanged, of a word to every beginning of another.
std::vector<std::size_t> distances(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i)
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        d[i][j] = i + j;
        continue;
      }
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d.back();
}

}  // namespace

std::string did_you_mean(const std::string& word, const std::vector<std::string>& candidates) {
  std::size_t nearest = word.size() / 3 + 2;  // more edits than this: another word
  std::string best;
  for (const auto& candidate : candidates) {
    const auto d = distances(lower_case(word), lower_case(candidate));
    std::size_t distance = d.back();
    if (word.size() > 3 && d.size() > 1) distance = std::min(distance, *std::min_element(d.begin() + 1, d.end()) + 1);
    if (distance < nearest) {
      nearest = distance;
      best = candidate;
    }
  }
  return best.empty() ? "" : fmt::format(" (did you mean '{}'?)", best);
}

std::string number_text(double x) {
  return x == 0 ? "0" : fmt::format("{}", x);
}

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') result += '\\';
    if (code < 0x20 || code == 0x7f)
      result += fmt::format("\\u{:04X}", code);
    else
      result += c;
  }
  return result + '"';
}

std::string listed(const std::vector<std::string>& words) {
  std::vector<std::string> marked;
  for (const auto& word : words) marked.push_back(quoted(word));
  return fmt::format("{}", fmt::join(marked, ", "));
}

std::string text_of(const geometry::Point& x) {
  return fmt::format("[{}, {}]", number_text(x.x()), number_text(x.y()));
}

std::string text_of(const std::vector<geometry::Point>& points) {
  std::vector<std::string> texts;
  for (const auto& point : points) texts.push_back(text_of(point));
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

std::string text_of(const std::vector<std::string>& words) {
  return "[" + listed(words) + "]";
}

}  // namespace plate
