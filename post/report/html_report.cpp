#include "post/report/html_report.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>

#include "plate/model/problem.hpp"
#include "post/files/atomic_file.hpp"
#include "post/files/table.hpp"
#include "post/files/vtk_series.hpp"
#include "post/report/curve_plot.hpp"
#include "post/report/html_data.hpp"
#include "post/report/html_page.hpp"
#include "post/report/pictures.hpp"

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
  add("lines", whole);
  add("crack_springs", whole);
  add("growth", whole);
  add("response", whole);
  add("reactions", [](const Table& table) { return columns_of(table, {"time", "support", "force"}); });
  add("edge_reactions", [](const Table& table) {
    return columns_of(table, {"time", "support", "s", "force_per_length", "moment_per_length", "twist_per_length",
                              "kirchhoff_force"});
  });
  add("cracks", whole);
  add("contact", whole);
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
                                 {"project", json_text(about.project)},
                                 {"author", json_text(about.author)},
                                 {"date", json_text(about.date)},
                                 {"summary", read_text(folder / "summary.json")},
                                 {"plate", plate_json(about.problem)},
                                 {"probes", json_object(probes)},
                                 {"tables", tables(folder)},
                                 {"pictures", pictures.json()},
                                 {"case", json_text(read_text(folder / "case.resolved.toml"))}});
  write_atomically(folder / "report.html", page(about.title, data));
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

namespace {

constexpr std::size_t most = 20000;  // rows of a table: all

std::string table_in(const fs::path& path) {
  return fs::exists(path) ? table_json(read_csv(path), most) : "null";
}

/// The folders of runs that have a report.
std::string reports_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder))
    if (fs::exists(entry.path() / "report.html")) names.push_back(json_text(entry.path().filename().string()));
  std::ranges::sort(names);
  return json_list(names);
}

/// Title of the existing report, or else the name of the folder.
std::string title_of(const fs::path& folder) {
  constexpr std::string_view mark = "\"title\":";
  const auto path = folder / "report.html";
  const auto text = fs::exists(path) ? read_text(path) : std::string();
  const auto at = text.find(mark);
  if (at == std::string::npos) return fs::absolute(folder / "").parent_path().filename().string();
  const auto begin = at + mark.size();  // a member of an object has a line of its own
  return nlohmann::json::parse(text.substr(begin, text.find(",\n", begin) - begin)).get<std::string>();
}

}  // namespace

void write_study_report(const fs::path& folder, const std::string& title) {
  const auto study = read_csv(folder / "study.csv");
  const auto end = std::ranges::find(study.columns, "quantity");
  std::vector<std::string> axes;
  for (auto name = study.columns.begin(); name != end; ++name) axes.push_back(json_text(*name));
  std::string along = "null";  // the axis that orders are of
  if (fs::exists(folder / "orders.csv")) {
    const auto others = read_csv(folder / "orders.csv").columns;
    for (auto name = study.columns.begin(); name != end; ++name)
      if (std::ranges::find(others.begin(), std::ranges::find(others, "quantity"), *name) ==
          std::ranges::find(others, "quantity"))
        along = json_text(*name);
  }
  const auto data = json_object({{"kind", json_text("study")},
                                 {"title", json_text(title)},
                                 {"axes", json_list(axes)},
                                 {"along", along},
                                 {"study", table_json(study, most)},
                                 {"orders", table_in(folder / "orders.csv")},
                                 {"runs", reports_in(folder)}});
  write_atomically(folder / "report.html", page(title, data));
}

void write_extremes_report(const fs::path& folder, const std::string& title) {
  const auto data = json_object({{"kind", json_text("extremes")},
                                 {"title", json_text(title)},
                                 {"extremes", table_in(folder / "extremes.csv")},
                                 {"runs", reports_in(folder)}});
  write_atomically(folder / "report.html", page(title, data));
}

void write_papers_report(const fs::path& folder, const CurvePlot& plot, const Table& table,
                         const std::vector<std::string>& links) {
  std::vector<std::string> names;
  for (const auto& name : links) names.push_back(json_text(name));
  const auto data = json_object({{"kind", json_text("papers")},
                                 {"title", json_text(plot.title)},
                                 {"papers", table_json(table, most)},
                                 {"panels", panels_json(plot)},
                                 {"runs", json_list(names)}});
  write_atomically(folder / "report.html", page(plot.title, data));
}

bool write_report_of_many(const fs::path& folder) {
  if (fs::exists(folder / "study.csv"))
    write_study_report(folder, title_of(folder));
  else if (fs::exists(folder / "extremes.csv"))
    write_extremes_report(folder, title_of(folder));
  else
    return false;
  return true;
}

}  // namespace post
