// The document in a page, taken apart again by other means: JSON and numbers are what was put in, and no text can break out.
#include "hamilcar/io/page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "io/files.hpp"
#include "support/json_schema.hpp"

namespace hamilcar::io {
namespace {

using nlohmann::json;

std::string between(const std::string& text, const std::string& begin, const std::string& end) {
    const auto from = text.find(begin);
    EXPECT_NE(from, std::string::npos) << begin;
    const auto start = from + begin.size();
    return text.substr(start, text.find(end, start) - start);
}

// RFC 4648 by its table of letters.
std::string decoded(const std::string& base64) {
    const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    unsigned bits = 0;
    int count = 0;
    for (const char c : base64) {
        if (c == '=') break;
        bits = bits << 6 | static_cast<unsigned>(letters.find(c));
        count += 6;
        if (count >= 8) {
            count -= 8;
            bytes += static_cast<char>(bits >> count & 255);
        }
    }
    return bytes;
}

class PageFile : public testing::Test {
protected:
    void write(const Page& page) {
        const std::string path = folder_ / "page.html";
        write_page(path, page);
        text_ = read_file(path);
        document_ =
            json::parse(between(text_, R"(<script id="hamilcar-document" type="application/json">)", "</script>"));
        if (page.runs.empty()) {
            EXPECT_EQ(test::PageSchema().mistake(document_, "page_document"), "");
        }
        bytes_ = decoded(between(text_, R"(<script id="hamilcar-columns" type="text/plain">)", "</script>"));
    }
    std::vector<double> column(const json& reference) const {
        std::vector<double> values;
        const bool single = reference["type"] == "f32";
        const std::size_t size = single ? 4 : 8, offset = reference["offset"];
        EXPECT_EQ(offset % 8, 0u);
        for (std::size_t i = 0; i < reference["count"]; ++i) {
            double wide = 0;
            float narrow = 0;
            if (single) {
                std::memcpy(&narrow, bytes_.data() + offset + 4 * i, 4);
            } else {
                std::memcpy(&wide, bytes_.data() + offset + 8 * i, 8);
            }
            values.push_back(single ? narrow : wide);
            EXPECT_LE(offset + size * (i + 1), bytes_.size());
        }
        return values;
    }

    TemporaryFolder folder_;
    std::string text_, bytes_;
    json document_;
};

TEST_F(PageFile, HasItsTextsTablesAndCharts) {
    Page page{.title = "A \"title\" <b>", .subtitle = "car", .blocks = {}, .runs = {}};
    page.blocks = {Heading{"h"},
                   Paragraph{"</script><script>alert(1)</script>"},
                   Table{"t", {{"name", ""}, {"value", "m"}}, {{"a", 1.5}, {"b", Cell()}, {"c", std::nan("")}}},
                   Chart{"c", "x [m]", "y [N]", {{"one", {1, 2, 3}, {4, std::nan(""), 6}, true}}, true, {{2, "mark"}}},
                   Chart{"empty", "", "", {{"", {1}, {std::nan("")}}}},
                   Replay{}};
    write(page);
    EXPECT_EQ(document_["title"], page.title);
    ASSERT_EQ(document_["blocks"].size(), 5u);  // without the chart of nothing
    EXPECT_EQ(document_["blocks"][1]["text"], "</script><script>alert(1)</script>");
    EXPECT_THAT(text_, testing::Not(testing::HasSubstr("<script>alert")));
    EXPECT_EQ(document_["blocks"][2]["rows"], json::parse(R"([["a", 1.5], ["b", null], ["c", null]])"));
    const json& chart = document_["blocks"][3];
    EXPECT_EQ(chart["y"]["logarithmic"], true);
    EXPECT_EQ(chart["x"]["label"], "x [m]");
    EXPECT_EQ(chart["marks"][0]["label"], "mark");
    EXPECT_EQ(column(chart["curves"][0]["x"]), (std::vector<double>{1, 2, 3}));
    EXPECT_EQ(column(chart["curves"][0]["y"])[2], 6);
    EXPECT_TRUE(std::isnan(column(chart["curves"][0]["y"])[1]));
}

TEST_F(PageFile, HasMapsWithConesBarriersAndLimits) {
    Page page{.title = "t", .subtitle = "", .blocks = {}, .runs = {}};
    Chart map{"path", "x [m]", "y [m]", {{"", {0, 1}, {2, 3}}}};
    map.equal_axes = true;
    map.marks = {{"cones", {0, 5, 10}, {1, -1, 1.5}}, {"", {7}, {8}}};
    map.lines = {{0, 1, 10, 1.5}, {0, -1, 10, -2}};
    map.horizontal_marks = {{3.5, "lane"}};
    page.blocks = {map, Chart{"plain", "", "", {{"", {1, 2}, {3, 4}}}}};
    write(page);
    const json& block = document_["blocks"][0];
    EXPECT_EQ(block["equal_axes"], true);
    ASSERT_EQ(block["cones"].size(), 2u);
    EXPECT_EQ(block["cones"][0]["label"], "cones");
    EXPECT_EQ(column(block["cones"][0]["x"]), (std::vector<double>{0, 5, 10}));
    EXPECT_EQ(column(block["cones"][0]["y"]), (std::vector<double>{1, -1, 1.5}));
    EXPECT_EQ(column(block["cones"][1]["y"]), std::vector<double>{8});
    EXPECT_EQ(block["lines"], json::parse("[[0, 1, 10, 1.5], [0, -1, 10, -2]]"));
    EXPECT_EQ(block["horizontal_marks"], json::parse(R"([{"y": 3.5, "label": "lane"}])"));
    const json& plain = document_["blocks"][1];  // as it was before there were maps
    for (const char* key : {"equal_axes", "cones", "lines", "horizontal_marks"})
        EXPECT_FALSE(plain.contains(key)) << key;
}

TEST_F(PageFile, HasVerdicts) {
    Page page{.title = "t", .subtitle = "", .blocks = {}, .runs = {}};
    page.blocks = {Verdicts{{{"no cone is hit", true, ""}, {"speed", false, "51.2 km/h"}}}, Verdicts{}};
    write(page);
    EXPECT_EQ(document_["blocks"][0], json::parse(R"({"kind": "verdicts", "list": [
        {"criterion": "no cone is hit", "passed": true, "found": ""},
        {"criterion": "speed", "passed": false, "found": "51.2 km/h"}]})"));
    EXPECT_EQ(document_["blocks"][1]["list"], json::array());
}

TEST_F(PageFile, HasEveryNumberOfARun) {
    PageRun run{.name = "r",
                .file = "results.nc",
                .columns = {{"time", "s", ""}, {"a", "m", "what"}, {"a.pose.x", "m", "", ChannelRole::pose_x, "a"}},
                .values = {{0, 0.1, 0.2}, {1. / 3, 1e300, -5}, {0.1, 0.2, 0.3}},
                .scene = R"({"vehicle": "v"})",
                .tiles = {{3, -4, {1.5f, 2.5f, 3.5f}}}};
    write({.title = "t",
           .subtitle = "",
           .blocks = {Replay{}},
           .runs = {run,
                    PageRun{.name = "no scene", .file = "", .columns = {}, .values = {}, .scene = "", .tiles = {}}}});
    const test::PageSchema schema;
    EXPECT_EQ(schema.mistake(document_["runs"][1], "run"), "");
    for (const json& channel : document_["runs"][0]["channels"]) {
        EXPECT_EQ(schema.mistake(channel, "recorded_channel"), "");
    }
    EXPECT_EQ(schema.mistake(document_["runs"][0]["tiles"][0], "run_tile"), "");
    const json& got = document_["runs"][0];
    EXPECT_EQ(got["channels"][1]["unit"], "m");
    EXPECT_EQ(column(got["channels"][0]["column"]), run.values[0]);
    EXPECT_EQ(column(got["channels"][1]["column"]), run.values[1]);  // to the last bit
    EXPECT_EQ(got["channels"][2]["column"]["type"], "f32");
    EXPECT_EQ(got["channels"][2]["role"], "pose_x");
    EXPECT_EQ(got["channels"][2]["of"], "a");
    EXPECT_EQ(column(got["channels"][2]["column"])[1], double(0.2f));
    EXPECT_EQ(got["scene"]["vehicle"], "v");
    EXPECT_EQ(got["tiles"][0]["iy"], -4);
    EXPECT_EQ(column(got["tiles"][0]["column"]), (std::vector<double>{1.5, 2.5, 3.5}));
    EXPECT_TRUE(document_["runs"][1]["scene"].is_null());
}

TEST_F(PageFile, IsTheProgramsOwnPageAroundTheDocument) {
    write({});
    const std::string_view shell = page_template();
    ASSERT_GT(shell.size(), 100u);
    EXPECT_EQ(text_.substr(0, 100), shell.substr(0, 100));
    EXPECT_EQ(text_.substr(text_.size() - 20), shell.substr(shell.size() - 20));
    EXPECT_EQ(shell.find("src=\"/"), std::string_view::npos) << "nothing is fetched";
}

TEST_F(PageFile, ThatCannotBeWrittenIsToldWithItsPath) {
    try {
        write_page("/nonexistent/page.html", {});
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::input_output);
        EXPECT_THAT(error.what(), testing::HasSubstr("/nonexistent/page.html: cannot write: No such file"));
    }
}

}  // namespace
}  // namespace hamilcar::io
