#pragma once
#include "cases/input/key_forms.hpp"
#include "post/report/quantity.hpp"

/// Forms of the files that run many cases: studies and tables of extremes. Nothing is written from them.
namespace cases {

/// An override "key=value" and where the file gives it.
struct Setting {
  std::string text, place;
};

/// Fields of one list and of another.
template <class T>
Fields<T> joined(Fields<T> fields, const Fields<T>& more) {
  fields.insert(fields.end(), more.begin(), more.end());
  return fields;
}

template <class T>
Field<T> entry(const std::string& name, const std::string& allowed, std::function<void(const Value&, T&)> read) {
  return {name, {{name, "", allowed, "", ""}}, std::move(read), {}};
}

template <class T, class Project>
Field<T> word(const std::string& name, Project project) {
  return entry<T>(name, "a string", [=](const Value& given, T& object) {
    const auto text = given.text();
    if (text && text->empty()) given.refuse("a string that is not empty");
    if (text) std::invoke(project, object) = *text;
  });
}

/// A file that is named relative to the one that is read.
inline std::filesystem::path file_beside(const Value& given, const std::string& name) {
  auto path = given.reading().folder / name;
  if (!std::filesystem::exists(path)) given.report_error(fmt::format("no such file: {}", path.string()));
  return path;
}

template <class T>
Field<T> case_file() {
  return entry<T>("case", "a case file", [](const Value& given, T& object) {
    const auto name = given.text();
    if (name) object.case_file = file_beside(given, *name);
  });
}

template <class T>
Field<T> settings() {
  return entry<T>("set", "", [](const Value& given, T& object) {
    for (const auto& element : given.elements("a list of overrides [\"key=value\", ...]"))
      if (const auto text = element.text()) object.set.push_back({*text, given.reading().found().place(element.key())});
  });
}

/// The keys quantity, tip and probe of an object with a member `quantity`.
template <class T>
Fields<T> quantity_fields() {
  Words<std::string> words;
  for (const auto& name : post::quantity_names()) words.allowed.emplace_back(name, name);
  const auto name = [](auto& object) -> auto& {
    return object.quantity.name;
  };
  const auto of_kind = [](const std::string& kind, const std::string& quantities) {
    return Condition<T>{"quantity", quantities,
                        [=](const T& object) { return post::kind_of_place(object.quantity.name) == kind; }};
  };
  const auto counted = [](const std::string& key, const std::string& allowed, double least,
                          std::optional<std::size_t> post::Quantity::*member) {
    return entry<T>(key, allowed,
                    [=](const Value& given, T& object) {
                      const auto number = given.number();
                      if (number && (*number < least || *number > 1e6 || *number != std::floor(*number)))
                        given.refuse(allowed);
                      else if (number)
                        object.quantity.*member = static_cast<std::size_t>(*number);
                    })
        .required();
  };
  const auto read_probe = [](const Value& given, T& object) { object.quantity.probe = given.text(); };
  return {choice<T, std::string>("quantity", name, words, "").required(),
          counted("tip", "the number of a crack tip, from 0", 0, &post::Quantity::tip)
              .with(of_kind("tip", "quantity = K1 ... F3, N1, N2, K1_peak ... K3_peak")),
          entry<T>("probe", "the name of a probe", read_probe)
              .required()
              .with(of_kind("probe", "quantity = w, theta_x, theta_y, u or v")),
          counted("mode", "the number of a mode, from 1", 1, &post::Quantity::mode)
              .with(of_kind("mode", "quantity = frequency"))};
}

}  // namespace cases
