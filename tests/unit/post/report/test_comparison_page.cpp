#include "post/report/html_page.hpp"

#include <nlohmann/json.hpp>

#include "post/report/curve_plot.hpp"
#include "tests/catch.hpp"

TEST_CASE("the page of a comparison has its curves and its norms") {
  const post::CurvePlot plot{"A < b",
                             {{"time",
                               "K1",
                               {{"finite elements", post::Line::reference, {{0, 1}, {2, 3}}},
                                {"computed", post::Line::computed, {{0, 0.5, 1}, {2, NAN, 3.5}}}}}}};
  const auto text = post::comparison_page(plot, "K1  0.1 %\n");
  const std::string mark = "id=\"data\">";
  const auto begin = text.find(mark) + mark.size();
  const auto data = nlohmann::json::parse(text.substr(begin, text.find("</script>", begin) - begin));
  CHECK(data["title"] == "A < b");
  CHECK(data["table"] == "K1  0.1 %\n");
  const auto& series = data["panels"][0]["series"];
  CHECK(series[0]["reference"] == true);
  CHECK(series[1]["reference"] == false);
  CHECK(series[1]["x"] == nlohmann::json{0, 0.5, 1});
  CHECK(series[1]["y"][1].is_null());
}
