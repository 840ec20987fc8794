#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace cases {

/// The files of cases/templates by name, as they were when the program was built.
const std::map<std::string, std::string_view>& templates();

/// Names of the templates, without ".toml".
std::vector<std::string> template_names();

/// Lists the templates: a name and what it shows, a line each.
std::string template_menu();

/// Writes the template into a file, by default NAME.toml here, and says what to do with it. The template of a study
/// writes its case beside it too, unless a file of that name is there. Throws CaseError where
/// there is no such template, or the file exists.
std::string new_case(const std::string& name, const std::string& file);

}  // namespace cases
