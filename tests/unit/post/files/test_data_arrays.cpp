#include "post/files/data_arrays.hpp"
#include "post/files/vtk_series.hpp"
#include "tests/catch.hpp"
#include "tests/unit/post/small_run.hpp"
#include "tests/unit/post/xml.hpp"

using small_run::TemporaryFolder, small_run::text_of;

TEST_CASE("what ParaView reads is well-formed XML") {
  CHECK(xml::error("<a>\n<b></a>") == "mismatched tag in line 2");
  CHECK(xml::error(std::string("<a>\0</a>", 8)) == "not well-formed (invalid token) in line 1");
  const TemporaryFolder folder;
  post::VtkSeries(folder.path(), small_run::mesh()).write(small_run::frame(0.25, 3));
  post::write_cracks(folder / "cracks.vtp", {{{{{0, 1}, {2, 3}}, {0, 4}}}, {{0, 0, {2, 3}, {}}}});
  post::write_cracks(folder / "none.vtp", {});
  REQUIRE(folder.entries() == 4);
  for (const char* name : {"fields_0000.vtu", "fields.pvd", "cracks.vtp", "none.vtp"}) {
    INFO(name);
    CHECK(xml::error(text_of(folder / name)) == "");
  }
}

TEST_CASE("bytes as text: the examples of RFC 4648") {
  const auto text = [](std::string_view bytes) { return post::base64(std::as_bytes(std::span(bytes))); };
  CHECK(text("") == "");
  CHECK(text("f") == "Zg==");
  CHECK(text("fo") == "Zm8=");
  CHECK(text("foobar") == "Zm9vYmFy");
}

namespace {

std::string_view content_of(std::string_view element) {
  const auto begin = element.find('>') + 1;
  return element.substr(begin, element.rfind("</") - begin);
}

}  // namespace

TEST_CASE("numbers of any count come back from their data array") {
  for (const std::size_t count : {0, 1, 2, 3, 4095, 4096, 4097, 20000}) {
    std::vector<double> numbers(count);
    for (std::size_t i = 0; i < count; ++i) numbers[i] = 0.1 * double(i);
    const auto text = post::data_array("a", numbers);
    CHECK((post::numbers_of<double>(content_of(text)) == numbers));
    CHECK((post::data_array("a", numbers) == text));
  }
  const std::vector<std::int64_t> integers{-1, 0, std::int64_t(1) << 40};
  CHECK(post::numbers_of<std::int64_t>(content_of(post::data_array("a", integers))) == integers);
  CHECK(post::data_array("a", std::vector<std::uint8_t>{5}).find("type=\"UInt8\" Name=\"a\" NumberOfTuples=\"1\"") ==
        11);
}

TEST_CASE("a data array that is damaged is refused") {
  const auto refuse = [](std::string_view text) {
    CAPTURE(text);
    CHECK_THROWS_WITH(post::numbers_of<double>(text), "an array is damaged");
  };
  for (const char* text : {"", " ", "AAAA", "AAAAAACAAAAAAAA", "AAAAAACAAAAAAAA*", "/////wCAAAAAAAAA",
                           "AQAAAP////8AAAAAAQAAAA==AAAA"})  // the last: a block of 4 GB
    refuse(text);
  const auto element = post::data_array("a", std::vector<double>(5000, 1.0 / 3));
  const std::string text(content_of(element));
  refuse(std::string_view(text).substr(0, text.size() - 9));
  refuse(text + "AAAA");
  refuse(text.substr(1, 60));
}
