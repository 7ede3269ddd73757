// Mistakes in OpenCRG files are told with their line.
#include "io/crg_samples.hpp"
#include "io/files.hpp"

namespace hamilcar::io {
namespace {

TEST(CrgFile, Mistakes) {
    const std::string minimal_row = " 0.0000000 0.0111111 0.0222222-0.0111111 0.0000000";
    const std::vector<BadInput> mistakes{
        {"misspelled", "LINE_INCREMENT", "LINE_INCREMNT", "REFERENCE_LINE", {"incremnt", "a key of $road_crg"}},
        {"no number", "= 1.0", "= one", "REFERENCE_LINE", {"reference_line_increment", "'one'"}},
        {"not a number", "= 1.0", "= nan", "REFERENCE_LINE", {"reference_line_increment", "'nan'"}},
        {"too much", "= 1.0", "= 1e999", "REFERENCE_LINE", {"1e999"}},
        {"no step", "= 1.0", "= 0", "REFERENCE_LINE", {"from 1e-06"}},
        {"twice", "= 1.0\n", "= 1.0\nreference_line_increment=2\n", "reference_line", {"once", "line 6"}},
        {"no value", " = 1.0", "", "REFERENCE_LINE", {"KEY = number"}},
        {"unit", "2,m", "2,mm", "D:long section 2", {"unit m, not 'mm'"}},
        {"number", "section 5", "section 6", "D:long section 6", {"from 1 to 5"}},
        {"mixed", "section 5", "section at v = 6", "$KD_Def", {"all sections by number"}},
        {"form", "LRFI", "LRFX", "#:LRFX", {"KRBI", "'lrfx'"}},
        {"row", minimal_row, " 0.0 abc", " 0.0 abc", {"long section 1", "'0.0 abc'"}},
        {"short row", minimal_row, " 0.0000000 0.0111111", " 0.0000000 0.0111111\n", {"long section 3", "missing"}},
        {"high", minimal_row, " 0.0000000       1e9       0.0       0.0       0.0", "       1e9", {"row 2"}},
        {"end", "= 1.0\n", "= 1.0\nREFERENCE_LINE_END_U = 4\n", "REFERENCE_LINE_END_U", {"3, where 4 rows"}},
        {"width", "= 0.50\n", "= 0.50\nLONG_SECTION_V_LEFT = 2\n", "LONG_SECTION_V_LEFT", {"expected 1,"}},
        {"other file", "$CT", "$ROAD_CRG_FILE", "$ROAD_CRG_FILE", {"another file is not supported"}},
        {"open section", "0.50\n$\n", "0.50\n", "$KD_Def", {"$road_crg", "ends this section"}},
        {"x only", "= 1.0\n", "= 1.0\nREFERENCE_LINE_END_X = 3\n", "REFERENCE_LINE_END_X", {"reference_line_end_y"}},
        {"line's end",
         "= 1.0\n",
         "= 1.0\nREFERENCE_LINE_END_X=3\nREFERENCE_LINE_END_Y=3\n",
         "REFERENCE_LINE_END_X",
         {"near (3, 0)"}},
        {"closed", "$ROAD_CRG ", "$ROAD_CRG_OPTS\nREFLINE_CONTINUATION = 2\n$\n$ROAD_CRG ", "REFLINE", {"from 0 to 1"}},
        {"border", "$ROAD_CRG ", "$ROAD_CRG_OPTS\nBORDER_MODE_U = 2.5\n$\n$ROAD_CRG ", "BORDER", {"whole number"}},
        {"point", "$ROAD_CRG ", "$ROAD_CRG_MODS\nREFPOINT_X = 1\n$\n$ROAD_CRG ", "REFPOINT", {"not supported"}},
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

TEST(CrgFile, NoData) {
    const auto end = minimal_crg.find("$$$$");
    expect_error([&] { parsed_crg(minimal_crg.substr(0, end)); }, ExitCode::bad_file, {"road.crg:18:", "$$$$"});
    expect_error([&] { parsed_crg(minimal_crg.substr(0, minimal_crg.find('\n', end) + 1)); }, ExitCode::bad_file,
                 {"two rows"});
    expect_error([] { parsed_crg(""); }, ExitCode::bad_file, {"$$$$"});
    expect_error([] { parsed_crg("$$$$\n"); }, ExitCode::bad_file, {"$kd_definition"});
}

TEST(CrgFile, Unreadable) {
    const TemporaryFolder folder;
    expect_error([&] { read_crg(folder / "none.crg"); }, ExitCode::input_output, {"none.crg", "No such file"});
    expect_error([&] { read_crg(folder / "."); }, ExitCode::input_output, {"directory"});
}

}  // namespace
}  // namespace hamilcar::io
