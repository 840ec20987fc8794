#include <fmt/format.h>

#include "post/manual/program.hpp"

namespace post {
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

std::string key_table(const std::vector<ManualKey>& keys) {
  std::string text = "| key | unit | allowed | default | meaning |\n|---|---|---|---|---|\n";
  for (const auto& key : keys)
    text += fmt::format("| `{}` | {} | {} | {} | {} |\n", key.name, key.unit, key.allowed, key.standard, key.help);
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

}  // namespace post
