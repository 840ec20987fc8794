#include "post/report/html/report.hpp"

#include "plate/model/problem.hpp"
#include "post/files/table.hpp"
#include "post/files/vtk/series.hpp"
#include "post/files/whole_file.hpp"
#include "post/report/html/page.hpp"
#include "post/report/html/plate_json.hpp"
#include "post/report/html/tables_json.hpp"

namespace post {
namespace {

namespace fs = std::filesystem;

/// The tables that there are, by their names.
std::string tables(const fs::path& folder) {
  Members members;
  const auto add = [&](const std::string& name, const auto& wanted) {
    const auto path = folder / (name + ".csv");
    if (fs::exists(path)) members.emplace_back(name, table_json(wanted(read_csv(path))));
  };
  const auto whole = [](Table table) { return table; };
  add("history", whole);
  add("probes", whole);
  add("growth", whole);
  add("response", whole);
  add("reactions", [](const Table& table) { return columns_of(table, {"time", "support", "force"}); });
  add("cracks", whole);
  add("srif", [](const Table& table) {
    return columns_of(recommended(table), {"time", "tip", "x", "y", "K1", "K2", "K3", "estimated_error_K1",
                                           "estimated_error_K2", "estimated_error_K3"});
  });
  add("tips", [](const Table& table) {
    return columns_of(table, {"advance", "time", "tip", "x", "y", "length", "speed"});
  });
  return json_object(members);
}

}  // namespace

void write_report(const fs::path& folder, const ReportedCase& about, const Pictures& pictures) {
  Members probes;
  for (const auto& [name, x] : about.probes)
    probes.emplace_back(name, json_list({json_number(x.x()), json_number(x.y())}));
  const auto data = json_object({{"kind", json_text("run")},
                                 {"title", json_text(about.title)},
                                 {"source", json_text(about.source)},
                                 {"units", json_text(about.units)},
                                 {"summary", read_text(folder / "summary.json")},
                                 {"plate", plate_json(about.problem)},
                                 {"probes", json_object(probes)},
                                 {"tables", tables(folder)},
                                 {"pictures", pictures.json()},
                                 {"case", json_text(read_text(folder / "case.resolved.toml"))}});
  write_whole(folder / "report.html", page(about.title, data));
}

void write_report(const fs::path& folder, const ReportedCase& about) {
  constexpr std::size_t most = 6;
  const auto frames = frames_in(folder);
  std::size_t stride = 1;
  while (frames.size() > most * stride + 1) stride *= 2;
  Pictures pictures;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (i % stride != 0 && i + 1 != frames.size()) continue;
    auto [mesh, frame] = read_frame(frames[i]);
    mesh.spacing = about.problem.discretization.spacing;
    pictures.open(mesh);
    pictures.look(frame);
  }
  write_report(folder, about, pictures);
}

}  // namespace post
