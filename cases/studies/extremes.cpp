#include "cases/studies/extremes.hpp"

namespace cases {
namespace {

using post::ConservedEnergy;
using post::EqualValue;
using post::KnownValue;

template <class T>
Fields<T> joined(Fields<T> fields, Fields<T> more) {
  fields.insert(fields.end(), more.begin(), more.end());
  return fields;
}

template <class T>
Field<T> tolerance() {
  return number<T>("tolerance", "-", &T::tolerance, positive, "").required();
}

Fields<Extremes> extremes_fields() {
  const auto value =
      joined<KnownValue>(quantity_fields<KnownValue>(),
                         {number<KnownValue>("is", "", &KnownValue::is, finite, "").required(), tolerance<KnownValue>(),
                          word<KnownValue>("source", &KnownValue::source).required()});
  const auto equal =
      joined<EqualValue>(quantity_fields<EqualValue>(),
                         {word<EqualValue>("row", &EqualValue::row).required(),
                          number<EqualValue>("factor", "-", &EqualValue::factor, finite, ""), tolerance<EqualValue>()});
  const Fields<ConservedEnergy> conserved{number<ConservedEnergy>("after", "time", &ConservedEnergy::after, {0}, ""),
                                          tolerance<ConservedEnergy>()};
  const Fields<ExtremeRow> row{
      word<ExtremeRow>("group", &ExtremeRow::group).required(),
      word<ExtremeRow>("title", &ExtremeRow::title).required(),
      case_file<ExtremeRow>().required(),
      settings<ExtremeRow>(),
      number<ExtremeRow>("time_step_share", "-", &ExtremeRow::time_step_share, positive, ""),
      table<ExtremeRow, KnownValue>("value", Layout::inline_, &ExtremeRow::value, value),
      table<ExtremeRow, EqualValue>("equal", Layout::inline_, &ExtremeRow::equal, equal),
      table<ExtremeRow, ConservedEnergy>("conserved", Layout::inline_, &ExtremeRow::conserved, conserved),
      word<ExtremeRow>("refused", &ExtremeRow::refused),
      word<ExtremeRow>("failed", &ExtremeRow::failed),
      word<ExtremeRow>("warned", &ExtremeRow::warned)};
  return {word<Extremes>("title", &Extremes::title), settings<Extremes>(),
          tables<Extremes, ExtremeRow>("row", Layout::block, &Extremes::rows, row)};
}

}  // namespace

Extremes read_extremes(const std::filesystem::path& path) {
  const toml::table root = parsed(path, "extremes");
  Reading reading(path.string());
  Extremes extremes;
  extremes.title = path.stem().string();
  read_fields(extremes_fields(), Value(root, "", reading), extremes);
  for (const auto& [key, what] : post::faults({extremes.rows.begin(), extremes.rows.end()}))
    if (reading.sound(key)) reading.complain(key, what);
  if (!reading.problems().empty()) throw CaseError(reading.problems());
  return extremes;
}

}  // namespace cases
