#include <algorithm>
#include <map>

#include "post/files/hdf5/datasets.hpp"

namespace post::hdf5 {
namespace {

/// Unit and description of a column of any table, by its name; numbers without a unit have none.
Meaning meaning_of_column(const std::string& name) {
  static const std::map<std::string, Meaning> known{
      {"time", {"time", "time of the row"}},
      {"begin", {"time", "when the piece of crack began"}},
      {"x", {"length", "position"}},
      {"y", {"length", "position"}},
      {"w", {"length", "deflection"}},
      {"u", {"length", "displacement along x"}},
      {"v", {"length", "displacement along y"}},
      {"max_abs_w", {"length", "largest deflection"}},
      {"length", {"length", "of the whole crack"}},
      {"piece", {"length", "of the piece of crack"}},
      {"crack_length", {"length", "of all cracks"}},
      {"angle", {"degree", "from x"}},
      {"speed", {"length/time", "of the tip"}},
      {"frequency", {"1/time", "frequency"}},
      {"omega", {"1/time", "circular frequency"}},
      {"force", {"force", "across the plate"}},
      {"largest_force", {"force", "of all steps so far"}},
      {"contact_time", {"time", "for which it has pressed so far"}},
      {"amplitude", {"1", "of the quantity, in its own units"}},
      {"phase", {"degree", "ahead of the load"}},
      {"position", {"length", "of what hits the plate"}},
      {"velocity", {"length/time", "of what hits the plate"}},
      {"s", {"length", "along an edge or a line"}},
      {"piece_length", {"length", "of the piece of the edge"}},
      {"force_per_length", {"force/length", "across the plate"}},
      {"moment_per_length", {"force", "M_nn at the edge"}},
      {"twist_per_length", {"force", "M_ns at the edge"}},
      {"kirchhoff_force", {"force/length", "across the plate, with twist as forces"}},
      {"moment_x", {"force length", "about x, through the origin"}},
      {"moment_y", {"force length", "about y, through the origin"}},
      {"displacement", {"force length", "sum of loads at factor 1 times displacements"}},
      {"energy_residual", {"force length", "what the books do not account for"}},
      {"G", {"force", "energy release rate"}},
      {"K1", {"force length^(1/2)", "moment intensity factor, without pi"}},
      {"K2", {"force length^(1/2)", "moment intensity factor, without pi"}},
      {"K3", {"force length^(-1/2)", "shear force intensity factor, without pi"}},
      {"N1", {"force length^(-1/2)", "membrane force intensity factor, without pi"}},
      {"N2", {"force length^(-1/2)", "membrane force intensity factor, without pi"}},
      {"estimated_error_K1", {"force length^(1/2)", "estimated error"}},
      {"estimated_error_K2", {"force length^(1/2)", "estimated error"}},
      {"estimated_error_K3", {"force length^(-1/2)", "estimated error"}},
      {"estimated_error_N1", {"force length^(-1/2)", "estimated error"}},
      {"estimated_error_N2", {"force length^(-1/2)", "estimated error"}}};
  if (const auto found = known.find(name); found != known.end()) return found->second;
  if (name.starts_with("theta")) return {"1", "rotation"};
  if (name.ends_with("energy") || name.ends_with("work")) return {"force length", name};
  return {"1", name};
}

void write_column(hid_t group, const Table& table, std::size_t column) {
  const std::string& name = table.columns[column];
  const Sizes sizes{table.rows.size()};
  const auto is_word = [&](const auto& row) { return std::holds_alternative<std::string>(row.at(column)); };
  if (std::ranges::any_of(table.rows, is_word)) {
    std::vector<std::string> words;
    for (const auto& row : table.rows) {
      const auto* number = std::get_if<double>(&row[column]);  // among words
      words.push_back(is_word(row) ? std::get<std::string>(row[column]) : number ? fmt::format("{}", *number) : "");
    }
    std::vector<const char*> pointers;
    for (const std::string& text : words) pointers.push_back(text.c_str());
    write_dataset_at_once(group, name, string_type(), sizes, pointers.data(), meaning_of_column(name));
  } else {
    std::vector<double> values;
    for (const auto& row : table.rows) {
      const auto* value = std::get_if<double>(&row.at(column));
      values.push_back(value ? *value : missing);
    }
    write_dataset_at_once(group, name, H5T_NATIVE_DOUBLE, sizes, values.data(), meaning_of_column(name));
  }
}

}  // namespace

void write_table(hid_t parent, const std::string& name, const Table& table) {
  if (checked(H5Lexists(parent, name.c_str(), H5P_DEFAULT), name) > 0)
    checked(H5Ldelete(parent, name.c_str(), H5P_DEFAULT), name);
  const Id group = new_group(parent, name);
  for (std::size_t column = 0; column < table.columns.size(); ++column) write_column(group, table, column);
}

}  // namespace post::hdf5
