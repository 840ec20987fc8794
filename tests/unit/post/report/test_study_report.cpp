#include "post/report/html_report.hpp"

#include <nlohmann/json.hpp>

#include "post/files/table.hpp"
#include "tests/catch.hpp"
#include "tests/unit/post/small_run.hpp"

using small_run::TemporaryFolder, small_run::text_of;

namespace {

nlohmann::json data_of(const std::filesystem::path& page) {
  const auto text = text_of(page);
  const std::string mark = "id=\"data\">";
  const auto begin = text.find(mark) + mark.size();
  return nlohmann::json::parse(text.substr(begin, text.find("</script>", begin) - begin));
}

}  // namespace

TEST_CASE("the report of a study has its axes, the refined one, and links to the runs that have reports") {
  const TemporaryFolder folder;
  post::write_csv(folder / "study.csv", {{"load", "spacing", "quantity", "computed", "seconds"},
                                         {{"bending", 0.1, "K1", 1.0, 2.0}, {"bending", 0.05, "K1", 1.1, 3.0}}});
  post::write_csv(folder / "orders.csv", {{"load", "quantity", "order"}, {{"bending", "K1", 2.0}}});
  std::filesystem::create_directory(folder / "with");
  std::filesystem::create_directory(folder / "without");
  std::ofstream(folder / "with" / "report.html") << "-";
  post::write_study_report(folder.path(), "A <title>, \"quoted\"");
  const auto data = data_of(folder / "report.html");
  CHECK(data["title"] == "A <title>, \"quoted\"");
  CHECK(data["axes"] == nlohmann::json{"load", "spacing"});
  CHECK(data["along"] == "spacing");
  CHECK(data["study"]["computed"] == nlohmann::json{1, 1.1});
  CHECK(data["runs"] == nlohmann::json{"with"});
  SECTION("again, under the same title") {
    const auto before = text_of(folder / "report.html");
    CHECK(post::write_report_of_many(folder.path()));
    CHECK(text_of(folder / "report.html") == before);
  }
}

TEST_CASE("the report of extremes has their verdicts, other folders have none") {
  const TemporaryFolder folder;
  CHECK_FALSE(post::write_report_of_many(folder.path()));
  post::write_csv(folder / "extremes.csv", {{"group", "row", "holds"}, {{"units", "a", "yes"}}});
  CHECK(post::write_report_of_many(folder.path()));
  const auto data = data_of(folder / "report.html");
  CHECK(data["kind"] == "extremes");
  CHECK(data["title"] == folder.path().filename().string());
  CHECK(data["extremes"]["holds"] == nlohmann::json{"yes"});
}
