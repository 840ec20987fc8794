#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>

#include "post/manual/program.hpp"

namespace post {
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

std::string completion(const std::string& shell, const Program& program, const std::vector<ManualKey>& keys,
                       const std::vector<std::string>& templates) {
  if (shell == "bash") return bash(program, keys, templates);
  if (shell == "fish") return fish(program, keys, templates);
  throw std::invalid_argument("\"" + shell + "\" given, must be one of \"bash\", \"fish\"");
}

}  // namespace post
