#include "cases/input/keys/forms.hpp"

namespace cases {

std::vector<std::string> chosen(const Value& given, const Words<int>& words) {
  std::vector<std::string> result;
  const auto names = given.texts();
  if (!names) return result;
  for (const auto& name : *names) {
    if (!words.find(given, name)) continue;
    if (std::find(result.begin(), result.end(), name) == result.end())
      result.push_back(name);
    else
      given.complain(fmt::format("\"{}\" is named twice", name));
  }
  return result;
}

bool bare(const std::string& name) {
  return !name.empty() &&
         std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; });
}

}  // namespace cases
