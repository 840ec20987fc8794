#include "post/report/html_page.hpp"

#include <nlohmann/json.hpp>

#include "tests/catch.hpp"

namespace {

std::string between(const std::string& text, const std::string& from, const std::string& to) {
  const auto begin = text.find(from) + from.size();
  return text.substr(begin, text.find(to, begin) - begin);
}

std::size_t count_in_page(const std::string& text, const std::string& part) {
  std::size_t result = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++result;
  return result;
}

}  // namespace

TEST_CASE("data of a report cannot end its block, and read back as they were") {
  const std::string evil = GENERATE("</script><script>alert(1)</script>", "<!-- <script>", "\"quoted\" \\ and\nbroken",
                                    "{{data}} {{title}}", "a < b && c > d",
                                    "Gr\xC3\xBC\xC3\x9F"
                                    "e");
  const auto page = post::page(evil, post::json_object({{"title", post::json_text(evil)}, {"x", "1"}}));
  const auto data = between(page, "id=\"data\">", "</script>");
  CHECK(data.find('<') == std::string::npos);
  const auto read = nlohmann::json::parse(data);
  CHECK(read["title"] == evil);
  CHECK(read["x"] == 1);
  CHECK(count_in_page(page, "</script>") == 2);
  CHECK(page.find("alert(1)</script>") == std::string::npos);
}

TEST_CASE("text that is not UTF-8 stays readable JSON") {
  CHECK(nlohmann::json::parse(post::json_text("a\xFF"
                                              "b"))
            .get<std::string>()
            .starts_with("a"));
}

TEST_CASE("numbers keep all their digits, and those that are not finite are null") {
  const double x = GENERATE(0.1, -1.0 / 3, 1e-300, 6.02214076e23, 0.0);
  CHECK(nlohmann::json::parse(post::json_number(x)).get<double>() == x);
  CHECK(post::json_number(NAN) == "null");
  CHECK(post::json_number(-INFINITY) == "null");
}

TEST_CASE("a page refers to nothing outside it") {
  const auto page = post::page("title", "{}");
  for (const char* part : {"src=", "@import", "url(", "<link", "fetch(", "XMLHttpRequest"}) {
    INFO(part);
    CHECK(page.find(part) == std::string::npos);
  }
  CHECK(page.find("{{") == std::string::npos);
}

TEST_CASE("every script and style of the folder is part of the page") {
  const auto page = post::page("title", "{}");
  REQUIRE(post::assets().size() > 10);
  for (const auto& [name, text] : post::assets()) {
    if (name == "page.html") continue;
    INFO(name);
    CHECK(page.find(text) != std::string::npos);
  }
}
