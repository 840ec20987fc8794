#include "cases/input/manual.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>

namespace cases {

std::vector<KeyStep> steps(const std::string& key) {
  std::vector<KeyStep> result;
  std::string word;
  const auto finish = [&] {
    if (word.empty()) return;
    const bool index =
        word.size() < 9 && std::all_of(word.begin(), word.end(), [](char c) { return c >= '0' && c <= '9'; });
    result.push_back(index && !result.empty() ? KeyStep(std::size_t(std::stoul(word))) : KeyStep(word));
    word.clear();
  };
  for (const char c : key)
    if (c == '.' || c == '[' || c == ']')
      finish();
    else if (c != ' ')
      word += c;
  finish();
  return result;
}

std::string dotted(const std::vector<KeyStep>& path) {
  std::string key;
  for (const auto& step : path)
    if (const auto* name = std::get_if<std::string>(&step))
      key += (key.empty() ? "" : ".") + *name;
    else
      key += fmt::format("[{}]", std::get<std::size_t>(step));
  return key;
}

namespace {

/// Keys that --set takes as they stand: [[load]] and [[support]] by the index of their first.
std::vector<std::string> settable(const std::vector<ManualKey>& keys) {
  std::vector<std::string> result;
  for (const auto& key : keys) {
    std::string name = key.name;
    for (auto i = name.find("[]"); i != std::string::npos; i = name.find("[]")) name.replace(i, 2, ".0");
    result.push_back(name);
  }
  return result;
}

std::vector<std::string> long_names(const std::vector<Program::Option>& options) {
  std::vector<std::string> result;
  for (const auto& option : options) result.insert(result.end(), option.names.begin(), option.names.end());
  return result;
}

std::string bash(const Program& program, const std::vector<ManualKey>& keys,
                 const std::vector<std::string>& templates) {
  std::vector<std::string> names;
  std::string cases;
  for (const auto& command : program.commands) {
    names.push_back(command.name);
    cases += fmt::format("    {}) options=\"{}\" ;;\n", command.name, fmt::join(long_names(command.options), " "));
  }
  return fmt::format(R"(# bash completion of {0}
_{0}() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} command=${{COMP_WORDS[1]}} options=
  if [[ $COMP_CWORD -eq 1 ]]; then
    COMPREPLY=($(compgen -W "{1} {2}" -- "$word"))
    return
  fi
  case $before in
    --set) compopt -o nospace 2> /dev/null; COMPREPLY=($(compgen -S = -W "{3}" -- "$word")); return ;;
    --unset) COMPREPLY=($(compgen -W "{3}" -- "$word")); return ;;
    keys) COMPREPLY=($(compgen -W "{3}" -- "$word")); return ;;
    new) COMPREPLY=($(compgen -W "{4}" -- "$word")); return ;;
  esac
  case $command in
{5}  esac
  if [[ $word == -* ]]; then
    COMPREPLY=($(compgen -W "$options --help" -- "$word"))
  else
    COMPREPLY=($(compgen -f -- "$word"))
  fi
}}
complete -o filenames -F _{0} {0}
)",
                     program.name, fmt::join(names, " "), fmt::join(long_names(program.options), " "),
                     fmt::join(settable(keys), " "), fmt::join(templates, " "), cases);
}

std::string fish(const Program& program, const std::vector<ManualKey>& keys,
                 const std::vector<std::string>& templates) {
  const auto quoted = [](std::string text) {
    for (std::size_t i = 0; (i = text.find_first_of("'\\", i)) != std::string::npos; i += 2) text.insert(i, 1, '\\');
    return "'" + text + "'";
  };
  std::string text = fmt::format("# fish completion of {}\n", program.name);
  for (const auto& command : program.commands) {
    text += fmt::format("complete -c {} -n __fish_use_subcommand -f -a {} -d {}\n", program.name, command.name,
                        quoted(command.about));
    for (const auto& option : command.options)
      for (const auto& name : option.names) {
        if (!name.starts_with("--")) continue;
        const bool key = name == "--set" || name == "--unset";
        text += fmt::format("complete -c {} -n '__fish_seen_subcommand_from {}' -l {}{} -d {}\n", program.name,
                            command.name, name.substr(2),
                            option.value.empty() ? ""
                            : key                ? fmt::format(" -x -a '{}'", fmt::join(settable(keys), " "))
                                                 : " -r",
                            quoted(option.about));
      }
  }
  return text + fmt::format("complete -c {} -n '__fish_seen_subcommand_from new' -f -a '{}'\n", program.name,
                            fmt::join(templates, " "));
}

}  // namespace

std::optional<std::string> completion(const std::string& shell, const Program& program,
                                      const std::vector<ManualKey>& keys, const std::vector<std::string>& templates) {
  if (shell == "bash") return bash(program, keys, templates);
  if (shell == "fish") return fish(program, keys, templates);
  return std::nullopt;
}

namespace {

/// Text that roff takes as it stands: no escapes, no requests at the beginning of a line.
std::string plain(const std::string& text) {
  std::string result;
  for (const char c : text)
    if (c == '\\')
      result += "\\e";
    else if (c == '-')
      result += "\\-";
    else if (c == '\n')
      result += ' ';
    else
      result += c;
  if (!result.empty() && (result.front() == '.' || result.front() == '\'')) result.insert(0, "\\&");
  return result;
}

std::string of_option(const Program::Option& option) {
  std::string names;
  for (const auto& name : option.names) names += fmt::format("{}\\fB{}\\fR", names.empty() ? "" : ", ", plain(name));
  const std::string value = option.value.empty() ? "" : fmt::format(" \\fI{}\\fR", plain(option.value));
  return fmt::format(".TP\n{}{}\n{}\n", names, value, plain(option.about));
}

std::string usage(const Program::Command& command) {
  std::string text;
  for (const auto& argument : command.arguments)
    text += argument.required ? fmt::format(" \\fI{}\\fR", plain(argument.name))
                              : fmt::format(" [\\fI{}\\fR]", plain(argument.name));
  return text + (command.options.empty() ? "" : " [\\fIoptions\\fR]");
}

}  // namespace

std::string key_lines(const std::vector<ManualKey>& keys, const std::string& wanted) {
  std::string text;
  for (const auto& key : keys)
    if (key.name.find(wanted) != std::string::npos)
      text += fmt::format("{:<36} {:<16} {}; {}\n{:36}   {}\n", key.name, "[" + key.unit + "]", key.allowed,
                          key.standard, "", key.help);
  return text;
}

std::string man_page(const Program& program, const std::vector<ManualKey>& keys) {
  std::string text = fmt::format(
      ".TH {0} 1 \"\" \"{1} {2}\" \"User Commands\"\n.SH NAME\n{1} \\- {3}\n.SH SYNOPSIS\n",
      [&] {
        std::string upper = program.name;
        for (char& c : upper) c = char(std::toupper(static_cast<unsigned char>(c)));
        return upper;
      }(),
      program.name, program.version, plain(program.about));
  for (const auto& command : program.commands)
    text += fmt::format("{}.B {} {}\n{}\n", text.ends_with("SYNOPSIS\n") ? "" : ".br\n", program.name, command.name,
                        usage(command).substr(usage(command).empty() ? 0 : 1));
  text += ".SH OPTIONS\n";
  for (const auto& option : program.options) text += of_option(option);
  text += ".SH COMMANDS\n";
  for (const auto& command : program.commands) {
    text += fmt::format(".SS {}{}\n{}\n", command.name, usage(command), plain(command.about));
    for (const auto& argument : command.arguments)
      text += fmt::format(".TP\n\\fI{}\\fR\n{}\n", plain(argument.name), plain(argument.about));
    for (const auto& option : command.options) text += of_option(option);
  }
  text += ".SH KEYS OF A CASE FILE\n";
  for (const auto& key : keys)
    text += fmt::format(".TP\n\\fB{}\\fR [{}]\n{}; default: {}. {}\n", plain(key.name), plain(key.unit),
                        plain(key.allowed), plain(key.standard), plain(key.help));
  return text +
         ".SH EXIT STATUS\n.TP\n0\ndone\n.TP\n1\ncompare: a tolerance is exceeded\n.TP\n2\nthe case file, an override "
         "or an argument is wrong; nothing is "
         "written\n"
         ".TP\n3\nthe numbers failed\n.TP\n4\nthe machine failed\n";
}

namespace {

using Json = nlohmann::ordered_json;

/// The words in quotation marks of a text.
std::vector<std::string> quoted_words(const std::string& text) {
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
  if (begins("[x, y, radius, from")) return numbers(5);
  if (begins("[x, y]") || begins("[a, b]")) return numbers(2);
  if (begins("{ name = factor")) return {{"type", "object"}, {"additionalProperties", {{"type", "number"}}}};
  if (begins("{ name")) return {{"type", "object"}, {"additionalProperties", numbers(2)}};
  if (begins("a list of \"")) return list({{"enum", quoted_words(text)}});
  if (begins("a list of") || begins("one name")) return list({{"type", "string"}});
  if (begins("one of")) return {{"enum", quoted_words(text)}};
  if (begins("true or false")) return {{"type", "boolean"}};
  for (const char* with : {"a string", "a CSV file", "a DXF file", "an expression", "letters", "name of a layer"})
    if (begins(with)) return {{"type", "string"}};
  if (text.find("table [[") != std::string::npos)
    return {{"anyOf", {{{"enum", quoted_words(text)}}, list(numbers(2))}}};
  if (begins("\"")) return {{"anyOf", {{{"enum", quoted_words(text)}}, of_number(text)}}};
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
    if (items && at->contains("type") && (*at)["type"] == "array")  // items that are lists or tables
      *at = Json{{"anyOf", Json::array({*at, Json::object()})}};
    if (items && at->contains("anyOf")) at = &(*at)["anyOf"][1];
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

}  // namespace cases
