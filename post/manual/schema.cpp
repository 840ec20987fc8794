#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "post/manual/program.hpp"

namespace post {
namespace {

using Json = nlohmann::ordered_json;

/// The words in quotation marks of a text.
std::vector<std::string> quoted(const std::string& text) {
  std::vector<std::string> result;
  const std::regex word("\"([^\"]*)\"");
  for (std::sregex_iterator i(text.begin(), text.end(), word), end; i != end; ++i) result.push_back((*i)[1]);
  return result;
}

Json numbers(std::size_t count) {
  return {{"type", "array"}, {"items", {{"type", "number"}}}, {"minItems", count}, {"maxItems", count}};
}

Json list(Json items) {
  return {{"type", "array"}, {"items", std::move(items)}};
}

/// "a number > 0", "an integer in [1, 1000)", "a finite number".
Json of_number(const std::string& text) {
  Json result{{"type", text.find("an integer") != std::string::npos ? "integer" : "number"}};
  std::smatch found;
  if (std::regex_search(text, found, std::regex(R"((>=?) ([-+.\de]+))")))
    result[found[1] == ">" ? "exclusiveMinimum" : "minimum"] = std::stod(found[2]);
  if (std::regex_search(text, found, std::regex(R"(in ([\[(])([-+.\de]+), ([-+.\de]+)([\])]))"))) {
    result[found[1] == "(" ? "exclusiveMinimum" : "minimum"] = std::stod(found[2]);
    result[found[4] == ")" ? "exclusiveMaximum" : "maximum"] = std::stod(found[3]);
  }
  return result;
}

/// The form of a value from the words of the key table.
Json of_value(const std::string& text) {
  const auto begins = [&](const char* with) { return text.starts_with(with); };
  if (begins("[ [[x, y]")) return list(list(numbers(2)));
  if (begins("[[xmin")) return list(numbers(4));
  if (begins("[[x, y]")) return list(numbers(2));
  if (begins("[xmin")) return numbers(4);
  if (begins("[x, y, radius]") || begins("[Mxx")) return numbers(3);
  if (begins("[x, y]") || begins("[a, b]")) return numbers(2);
  if (begins("{ name = factor")) return {{"type", "object"}, {"additionalProperties", {{"type", "number"}}}};
  if (begins("{ name")) return {{"type", "object"}, {"additionalProperties", numbers(2)}};
  if (begins("a list of \"")) return list({{"enum", quoted(text)}});
  if (begins("a list of") || begins("one name")) return list({{"type", "string"}});
  if (begins("one of")) return {{"enum", quoted(text)}};
  if (begins("true or false")) return {{"type", "boolean"}};
  if (begins("a string") || begins("an expression") || begins("letters")) return {{"type", "string"}};
  if (text.find("table [[") != std::string::npos) return {{"anyOf", {{{"enum", quoted(text)}}, list(numbers(2))}}};
  if (begins("\"")) return {{"anyOf", {{{"enum", quoted(text)}}, of_number(text)}}};
  return of_number(text);
}

/// The place of a key: "load[].kind" is below the items of "load".
Json& place(Json& root, const std::string& name) {
  Json* at = &root;
  std::size_t begin = 0;
  for (std::size_t end; (end = name.find('.', begin)) != std::string::npos; begin = end + 1) {
    std::string part = name.substr(begin, end - begin);
    const bool items = part.ends_with("[]");
    if (items) part.resize(part.size() - 2);
    Json& child = (*at)["properties"][part];
    if (child.is_null()) child = items ? Json{{"type", "array"}} : Json::object();
    at = items ? &child["items"] : &child;
    (*at)["type"] = "object";
    (*at)["additionalProperties"] = false;
  }
  return (*at)["properties"][name.substr(begin)];
}

}  // namespace

std::string schema(const std::string& title, const std::vector<ManualKey>& keys) {
  Json root{{"$schema", "http://json-schema.org/draft-07/schema#"},
            {"title", title},
            {"type", "object"},
            {"properties", Json::object()},
            {"additionalProperties", false}};
  for (const auto& key : keys) {
    Json& at = place(root, key.name);
    at = of_value(key.allowed);
    at["description"] = fmt::format("{} [{}]; default: {}", key.help, key.unit, key.standard);
  }
  constexpr int indent = 2;
  return root.dump(indent) + "\n";
}

}  // namespace post
