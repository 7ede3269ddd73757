// Mistakes in OpenCRG files are told with their line.
#include <cstdlib>
#include <functional>

#include "io/crg_samples.hpp"
#include "io/files.hpp"

namespace hamilcar::io {
namespace {

TEST(CrgFile, Mistakes) {
    const std::string minimal_row = " 0.0000000 0.0111111 0.0222222-0.0111111 0.0000000";
    const std::vector<BadInput> mistakes{
        {"no number", "= 1.0", "= one", "REFERENCE_LINE", {"reference_line_increment", "'one'"}},
        {"not a number", "= 1.0", "= nan", "REFERENCE_LINE", {"reference_line_increment", "'nan'"}},
        {"too much", "= 1.0", "= 1e999", "REFERENCE_LINE", {"1e99"}},
        {"no step", "= 1.0", "= 0", "REFERENCE_LINE", {"from 1e-06"}},
        {"no value", " = 1.0", "", "REFERENCE_LINE", {"KEY = number"}},
        {"unit", "2,m", "2,mm", "D:long section 2", {"unit m, not 'mm'"}},
        {"number", "section 5", "section 6", "D:long section 6", {"from 1 to 5"}},
        {"mixed", "section 5", "section at v = 6", "$KD_Def", {"all sections by number"}},
        {"form", "LRFI", "LRFX", "#:LRFX", {"KRBI", "'lrfx'"}},
        {"row", minimal_row, " 0.0 abc", " 0.0 abc", {"long section 1", "'0.0 abc'"}},
        {"short row", minimal_row, " 0.0000000 0.0111111", " 0.0000000 0.0111111\n", {"long section 3", "missing"}},
        {"high", minimal_row, " 0.0000000       1e9       0.0       0.0       0.0", "       1e9", {"row 2"}},
        {"channel of x", "section 5", "section 5,m\nD:reference line x", "D:reference line x", {"x and y are not"}},
        {"open section", "= -1\n$\n", "= -1\n", "$KD_Def", {"$road_crg", "ends this section"}},
        {"closed", "$ROAD_CRG ", "$ROAD_CRG_OPTS\nREFLINE_CONTINUATION = 2\n$\n$ROAD_CRG ", "REFLINE", {"from 0 to 1"}},
        {"border", "$ROAD_CRG ", "$ROAD_CRG_OPTS\nBORDER_MODE_U = 2.5\n$\n$ROAD_CRG ", "BORDER", {"whole number"}},
        {"point", "$ROAD_CRG ", "$ROAD_CRG_MODS\nREFPOINT_X = 1e9\n$\n$ROAD_CRG ", "REFPOINT", {"to 1e+08"}},
    };
    for (const BadInput& bad : mistakes) {
        SCOPED_TRACE(bad.name);
        const std::string text = changed(minimal_crg, bad.from, bad.to);
        const std::string at = position_in(text, bad.at);
        std::vector<std::string> pieces = bad.pieces;
        pieces.push_back("road.crg:" + at.substr(0, at.find(':')) + ": key ");
        expect_error([&] { parsed_crg(text); }, ExitCode::bad_file, pieces);
    }
}

// Forward 3 m, and back to 0.5 m: by OpenCRG's weights the line is at 0, 1/6, 1/18 and 1/2 m. Found by the fuzzer.
TEST(CrgFile, AnEndThatFoldsTheLineIsAMistake) {
    const std::string text =
        "$ROAD_CRG\nREFERENCE_LINE_INCREMENT = 1\nLONG_SECTION_V_INCREMENT = 2\nREFERENCE_LINE_END_X = 0.5\n"
        "REFERENCE_LINE_END_Y = 0\n$\n$KD_DEFINITION\n#:LRFI\nD:reference line phi,rad\nD:long section 1,m\n"
        "D:long section 2,m\n$\n$$$$\n       0.0       0.0       0.0\n       0.0       0.0       0.0\n"
        "       0.0       0.0       0.0\n       0.0       0.0       0.0\n";
    expect_error([&] { parsed_crg(text); }, ExitCode::bad_file,
                 {"road.crg:4: key reference_line_end_x: ", "right angle between rows, as it does at u = 1 m"});
}

// What OpenCRG's tools pass over is read as they read it, and told.
TEST(CrgFile, WhatIsPassedOverIsTold) {
    struct Oddity {
        std::string name, from, to, remark;
        std::function<bool(const CrgDescription&)> read;
    };
    const std::vector<Oddity> oddities{
        {"misspelled", "LINE_INCREMENT", "LINE_INCREMNT", ":6: key 'reference_line_incremnt' is no key of $road_crg",
         [](const CrgDescription& d) { return d.u_increment == 0.01; }},
        {"twice", "= 1.0\n", "= 1.0\nreference_line_increment=2\n",
         ":7: key 'reference_line_increment' is in line 6 too",
         [](const CrgDescription& d) { return d.u_increment == 2; }},
        {"section twice", "$ROAD_CRG ",
         "$ROAD_CRG_OPTS\nBORDER_MODE_U=1\n$\n$ROAD_CRG_OPTS\nBORDER_OFFSET_U=3\n$\n$ROAD_CRG ",
         ":8: key '$road_crg_opts' is there in line 5 too: the later one counts alone",
         [](const CrgDescription& d) { return d.border_u == CrgBorder::keep && d.border_offset_u == 3; }},
        {"road twice", "$ROAD_CRG ", "$ROAD_CRG\nREFERENCE_LINE_START_X=4\n$\n$ROAD_CRG ", "the later one adds to it",
         [](const CrgDescription& d) { return d.x == 4 && d.u_increment == 1; }},
        {"unit behind", "= 1.0\n", "= 1.5 m\n", ":6: key 'reference_line_increment' = '1.5 m' is read as 1.5",
         [](const CrgDescription& d) { return d.u_increment == 1.5; }},
        {"length", "= 1.0\n", "= 1.0\nREFERENCE_LINE_END_U = 4\n",
         ":7: key 'reference_line_end_u' is not used: 4 rows of data lead to 3",
         [](const CrgDescription& d) { return d.rows() == 4; }},
        {"width", "= 0.50\n", "= 0.50\nLONG_SECTION_V_LEFT = 2\n",
         ":8: key 'long_section_v_left' is not used: 5 sections end at 1",
         [](const CrgDescription& d) { return d.v.back() == 1; }},
        {"no right border", "LONG_SECTION_V_RIGHT = -1\n", "",
         "'long_section_v_right' is missing: the first section lies on the reference line",
         [](const CrgDescription& d) { return d.v.front() == 0 && d.v.back() == 2; }},
        {"x only", "= 1.0\n", "= 1.0\nREFERENCE_LINE_END_X = 3\n",
         ":7: key 'reference_line_end_x' is not used without its fellow",
         [](const CrgDescription& d) { return !d.end_x; }},
        {"line's end", "= 1.0\n", "= 1.0\nREFERENCE_LINE_END_X=3\nREFERENCE_LINE_END_Y=3\n",
         ":7: key 'reference_line_end_x' is far from (3, 0) m, where the headings lead: the line goes straight on",
         [](const CrgDescription& d) { return !d.end_x; }},
        {"line's end in height", "= 1.0\n", "= 1.0\nREFERENCE_LINE_START_S=.1\nREFERENCE_LINE_END_Z=3\n",
         ":8: key 'reference_line_end_z' is far from 0.3 m, where the slopes lead: the line is drawn there",
         [](const CrgDescription& d) { return d.end_z == 3; }},
    };
    for (const Oddity& odd : oddities) {
        SCOPED_TRACE(odd.name);
        const CrgDescription d = parsed_crg(changed(minimal_crg, odd.from, odd.to));
        EXPECT_THAT(d.remarks, testing::ElementsAre(testing::HasSubstr(odd.remark)));
        EXPECT_TRUE(odd.read(d));
    }
    EXPECT_THAT(parsed_crg(minimal_crg).remarks, testing::IsEmpty());
}

TEST(CrgFile, NoData) {
    const auto end = minimal_crg.find("$$$$");
    expect_error([&] { parsed_crg(minimal_crg.substr(0, end)); }, ExitCode::bad_file, {"road.crg:19:", "$$$$"});
    expect_error([&] { parsed_crg(minimal_crg.substr(0, minimal_crg.find('\n', end) + 1)); }, ExitCode::bad_file,
                 {"two rows"});
    expect_error([] { parsed_crg(""); }, ExitCode::bad_file, {"$$$$"});
    expect_error([] { parsed_crg("$$$$\n"); }, ExitCode::bad_file, {"$kd_definition"});
}

// A file that refers to others, however many: its own options and modifiers go before theirs.
TEST(CrgFile, RefersToAnother) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "roads");
    const std::string options = "$ROAD_CRG_OPTS\nBORDER_MODE_U = 1\n$\n", modifiers = "$ROAD_CRG_MODS\n$\n";
    folder.write("roads/data.crg", options + "$ROAD_CRG_MODS\nSCALE_Z_GRID = 2\n$\n" + minimal_crg);
    const auto reference = [](const std::string& path) {
        return "$ROAD_CRG_FILE ! remark\n* remark\n" + path + "\n$\n";
    };
    folder.write("roads/second.crg", reference("data.crg ! beside this one") + modifiers);
    const CrgDescription first = read_crg(folder.write("first.crg", reference("  roads/sec\n  ond.crg")));
    EXPECT_EQ(first.border_u, CrgBorder::zero);
    EXPECT_EQ(first.heights[6], 0.0111111) << "the modifiers nearest to the reader count alone";
    const CrgDescription direct = read_crg(folder / "roads/data.crg");
    EXPECT_EQ(direct.heights[6], 2 * 0.0111111);

    const std::string own = "$ROAD_CRG_OPTS\nBORDER_MODE_U = 4\n$\n";
    EXPECT_EQ(read_crg(folder.write("own.crg", reference("roads/second.crg") + own)).border_u, CrgBorder::reflect);

    ::setenv("HAMILCAR_TEST_ROADS", (folder / "roads").c_str(), 1);
    EXPECT_EQ(read_crg(folder.write("variable.crg", reference("  $HAMILCAR_TEST_ROADS/data.crg"))).rows(), 4U);
    expect_error([&] { read_crg(folder.write("unset.crg", reference("  $HAMILCAR_NO_SUCH/data.crg"))); },
                 ExitCode::bad_file, {"unset.crg:1:", "'HAMILCAR_NO_SUCH'"});
    expect_error([&] { read_crg(folder.write("loop.crg", reference("loop.crg"))); }, ExitCode::bad_file,
                 {"loop.crg:1:", "do not refer to each other"});
    expect_error([&] { read_crg(folder.write("none.crg", reference("nothing.crg"))); }, ExitCode::input_output,
                 {"none.crg: $road_crg_file: ", "nothing.crg", "No such file"});
}

TEST(CrgFile, Unreadable) {
    const TemporaryFolder folder;
    expect_error([&] { read_crg(folder / "none.crg"); }, ExitCode::input_output, {"none.crg", "No such file"});
    expect_error([&] { read_crg(folder / "."); }, ExitCode::input_output, {"directory"});
}

}  // namespace
}  // namespace hamilcar::io
