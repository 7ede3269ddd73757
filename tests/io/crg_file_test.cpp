// OpenCRG files by hand read as they are meant.
#include "hamilcar/io/crg_file.hpp"

#include <array>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <tuple>

#include "hamilcar/road/crg_road.hpp"
#include "io/crg_samples.hpp"
#include "io/files.hpp"

namespace hamilcar::io {
namespace {

const double pi = std::acos(-1.0);

TEST(CrgFile, MinimalByHand) {
    const CrgDescription d = parsed_crg(minimal_crg);
    EXPECT_EQ(d.rows(), 4U);
    EXPECT_EQ(d.v, (std::vector<double>{-1, -0.5, 0, 0.5, 1}));
    EXPECT_EQ(d.u_increment, 1);
    EXPECT_EQ(d.u_end(), 3);
    EXPECT_TRUE(d.headings.empty() && d.slopes.empty() && d.bankings.empty() && !d.end_x && !d.end_z);
    EXPECT_EQ(d.heights[5 * 1 + 2], 0.0222222);
    EXPECT_EQ(d.heights[5 * 1 + 3], -0.0111111);
    EXPECT_TRUE(std::isnan(d.heights[5 * 2 + 3]) && std::isnan(d.heights[5 * 2 + 4]));
    EXPECT_EQ(d.border_u, CrgBorder::keep);
    EXPECT_EQ(d.border_v, CrgBorder::keep);
    EXPECT_EQ(d.missing, CrgMissing::keep);

    const CrgRoad road(d);
    EXPECT_NEAR(road.height(1.0, 0.25), (0.0222222 - 0.0111111) / 2, 1e-12);
    EXPECT_NEAR(road.height(1.5, -0.5), 0.0111111 / 2, 1e-12);
    EXPECT_NEAR(road.height(2.5, 1.0), 0.05, 1e-12) << "the missing one is that to its right, 0";
    EXPECT_NEAR(road.height(7.0, 9.0), 0.1, 1e-12) << "the corner goes on";
}

TEST(CrgFile, LineEndsOfEveryKindAndAByteOrderMark) {
    for (const std::string end : {"\n", "\r\n", "\r"}) {
        std::string text = "\xef\xbb\xbf";
        for (const char c : minimal_crg) text += c == '\n' ? end : std::string(1, c);
        EXPECT_EQ(parsed_crg(text).heights[7], parsed_crg(minimal_crg).heights[7]);
        EXPECT_EQ(parsed_crg(text).rows(), 4U);
    }
}

// Everything that a header may say, and the channels in another order than the sections.
const std::string full = R"($ROAD_CRG_OPTS
BORDER_MODE_U = 1
border_mode_v = 4
BORDER_OFFSET_U = 0.5
BORDER_OFFSET_V = -0.25
BORDER_SMOOTH_UBEG = 0.1
BORDER_SMOOTH_UEND = 0.2
REFLINE_CONTINUATION = 0
WARN_MSGS = 5
CHECK_EPS = 1e-6
$
$ROAD_CRG
REFERENCE_LINE_START_U = 10
REFERENCE_LINE_END_U = 11.0d0
REFERENCE_LINE_INCREMENT = 0.5
REFERENCE_LINE_START_X = 1
REFERENCE_LINE_START_Y = 2
REFERENCE_LINE_START_Z = 3
REFERENCE_LINE_START_PHI = 0.0
REFERENCE_LINE_START_B = 0.01
REFERENCE_LINE_OFFSET_X = 4711
REFERENCE_LINE_START_LON = 13.4
$
$KD_DEFINITION
#:LDFI
U:reference line u,m,10.000,0.500
D:long section at v = 2.0,m
D:Reference Line  Phi, rad
D:friction,1
D:long section at v = -1,m
D:long section at v = 0.25,m
D:reference line slope,m/m
$
$$
                 2.0           *missing*                 0.9                -1.0
                0.25           *missing*
                 2.1                 0.1                 0.9                -1.1
               0.251              0.01d0
                 2.2                 0.2                 0.9                -1.2
               0.252               -0.02

)";

TEST(CrgFile, FullByHand) {
    const CrgDescription d = parsed_crg(full);
    EXPECT_EQ(d.u_start, 10);
    EXPECT_EQ(d.u_increment, 0.5);
    EXPECT_EQ(std::tuple(d.x, d.y, d.z), std::tuple(1.0, 2.0, 3.0));
    EXPECT_EQ(d.banking, 0.01);
    EXPECT_EQ(d.headings, (std::vector<double>{0.1, 0.2}));
    EXPECT_EQ(d.slopes, (std::vector<double>{0.01, -0.02}));
    EXPECT_EQ(d.v, (std::vector<double>{-1, 0.25, 2}));
    EXPECT_EQ(d.heights, (std::vector<double>{-1, 0.25, 2, -1.1, 0.251, 2.1, -1.2, 0.252, 2.2}));
    EXPECT_EQ(d.border_u, CrgBorder::zero);
    EXPECT_EQ(d.border_v, CrgBorder::reflect);
    EXPECT_EQ(std::tuple(d.border_offset_u, d.border_offset_v), std::tuple(0.5, -0.25));
    EXPECT_EQ(std::tuple(d.smooth_start, d.smooth_end), std::tuple(0.1, 0.2));
    EXPECT_NEAR(CrgRoad(d).height_uv(10.75, -1.0), -1.15 + 3 + 0.005 - 0.005 - 0.01, 1e-12);
}

TEST(CrgFile, ModifiersAreApplied) {
    const std::string mods = R"($ROAD_CRG_MODS
SCALE_Z_GRID = 2
SCALE_SLOPE = 3
SCALE_BANKING = 4
SCALE_LENGTH = 0.5
SCALE_WIDTH = 10
SCALE_CURVATURE = -1
REFLINE_ROTCENTER_X = 0
REFLINE_ROTCENTER_Y = 0
REFLINE_OFFSET_PHI = 1.5707963267948966
REFLINE_OFFSET_X = 100
REFLINE_OFFSET_Y = 200
REFLINE_OFFSET_Z = 300
$
$ROAD_CRG
)";
    const CrgDescription d = parsed_crg(changed(full, "$ROAD_CRG\n", mods));
    EXPECT_EQ(d.heights[0], -2);
    EXPECT_NEAR(d.slopes[1], -0.06, 1e-15);
    EXPECT_NEAR(d.banking, 0.04, 1e-15);
    EXPECT_EQ(d.u_increment, 0.25);
    EXPECT_EQ(d.u_end(), 10.5);
    EXPECT_EQ(d.v, (std::vector<double>{-10, 2.5, 20}));
    EXPECT_NEAR(d.headings[0], -0.1 + pi / 2, 1e-12);
    EXPECT_NEAR(d.headings[1], -0.2 + pi / 2, 1e-12);
    EXPECT_NEAR(d.x, 100 - 2, 1e-12) << "(1, 2) turned to the left is (-2, 1)";
    EXPECT_NEAR(d.y, 200 + 1, 1e-12);
    EXPECT_EQ(d.z, 303);
    EXPECT_EQ(d.missing, CrgMissing::none) << "with a section of modifiers only what it says is done";
}

TEST(CrgFile, MissingHeightsByModifier) {
    const auto missing = [](const std::string& mods) {
        return parsed_crg(changed(minimal_crg, "$ROAD_CRG ", "$ROAD_CRG_MODS\n" + mods + "$\n$ROAD_CRG "));
    };
    EXPECT_EQ(missing("GRID_NAN_MODE = 1\n").missing, CrgMissing::zero);
    EXPECT_EQ(missing("GRID_NAN_OFFSET = 0.1\n").missing, CrgMissing::keep);
    EXPECT_EQ(missing("GRID_NAN_OFFSET = 0.1\n").missing_offset, 0.1);
    EXPECT_EQ(missing("GRID_NAN_MODE = 0\nGRID_NAN_OFFSET = 0.1\n").missing_offset, 0) << "fills in nothing";
    EXPECT_EQ(missing("").missing, CrgMissing::none);
}

TEST(CrgFile, BinaryByHand) {
    const std::string header = R"($ROAD_CRG
REFERENCE_LINE_INCREMENT = 2
LONG_SECTION_V_INCREMENT = 1
LONG_SECTION_V_RIGHT = -0.5
$
$KD_DEFINITION
#:KRBI
D:long section 1,m
D:long section 2,m
$
$$$$
)";
    std::string data{"\x3f\x80\x00\x00\xbf\x00\x00\x00\x40\x00\x00\x00\x7f\xc0\x00\x00", 16};  // 1, -1/2; 2, none
    while (data.size() < 80) data += std::string("\x7f\xc0\x00\x00", 4);
    const CrgDescription d = parsed_crg(header + data);
    ASSERT_EQ(d.rows(), 2U);
    EXPECT_EQ(d.v, (std::vector<double>{-0.5, 0.5}));
    EXPECT_EQ(std::tuple(d.heights[0], d.heights[1], d.heights[2]), std::tuple(1.0, -0.5, 2.0));
    EXPECT_TRUE(std::isnan(d.heights[3]));
    EXPECT_EQ(parsed_crg(header + data.substr(0, 16)).rows(), 2U) << "a last record may be cut short";

    const std::string told = changed(header, "INCREMENT = 2", "INCREMENT = 2\nREFERENCE_LINE_END_U = 2");
    EXPECT_EQ(parsed_crg(told + data + data).rows(), 2U)
        << "what is behind the end that the header tells does not count";
    expect_error([&] { parsed_crg(told + data.substr(0, 8)); }, ExitCode::bad_file, {":3:", "1 rows of data"});
    const std::string longer = changed(header, "INCREMENT = 2", "INCREMENT = 2\nREFERENCE_LINE_END_U = 60");
    expect_error([&] { parsed_crg(longer + data); }, ExitCode::bad_file, {":3:", "reference_line_end_u"});

    const std::string records = changed(header, "KRBI", "LRBI");
    const std::string row_of_record = data.substr(0, 8) + std::string(72, '\0');
    const CrgDescription by_records = parsed_crg(records + row_of_record + row_of_record);
    EXPECT_EQ(by_records.rows(), 2U) << "a long row begins with a record";
    EXPECT_EQ(by_records.heights, (std::vector<double>{1, -0.5, 1, -0.5}));
}

TEST(CrgFile, CompactTextGoesOnAcrossLines) {
    std::string text = changed(minimal_crg, "LRFI", "KRFI");
    const auto rows = text.find("$$$$");
    for (auto at = text.find('\n', rows); (at = text.find('\n', at + 1)) != std::string::npos;) text.erase(at, 1);
    EXPECT_THAT(parsed_crg(text).heights, testing::SizeIs(20));
    EXPECT_EQ(parsed_crg(text).heights[7], 0.0222222);
}

TEST(CrgFile, AChannelOfUCountsBeforeTheHeader) {
    const auto with_u = [](const std::array<const char*, 4>& u) {
        std::string text = changed(minimal_crg, "D:long section 1,m", "D:reference line u,m\nD:long section 1,m");
        auto at = text.find('\n', text.find("$$$$"));
        for (const char* number : u) {
            text.insert(at + 1, std::string(10 - std::string(number).size(), ' ') + number);
            at = text.find('\n', at + 1);
        }
        return text;
    };
    const CrgDescription d = parsed_crg(with_u({"3", "5", "7", "9.03"}));
    EXPECT_EQ(d.u_start, 3);
    EXPECT_NEAR(d.u_increment, 2.01, 1e-12);
    EXPECT_EQ(d.heights[7], 0.0222222);
    expect_error([&] { parsed_crg(with_u({"3", "5", "7", "10"})); }, ExitCode::bad_file, {"line u", "even steps"});
    expect_error([&] { parsed_crg(with_u({"3", "5", "5", "7"})); }, ExitCode::bad_file, {"line u", "0 m to row 3"});
    expect_error([&] { parsed_crg(with_u({"3", "5", "nan", "7"})); }, ExitCode::bad_file, {"line u", "to row 3"});
}

TEST(CrgFile, UnusedIsZero) {
    const CrgDescription d = parsed_crg(changed(minimal_crg, " *missing* *missing*", "**unused** *missing*"));
    EXPECT_EQ(d.heights[13], 0);
    EXPECT_TRUE(std::isnan(d.heights[14]));
}

// By hand: the point (u, v) = (1, 0.5) of a line that climbs by a tenth, set down at (10, 20, 30) with another heading.
TEST(CrgFile, AReferencePointIsSetDown) {
    const auto placed = [](const std::string& mods) {
        std::string text = changed(minimal_crg, "= 1.0\n", "= 1.0\nREFERENCE_LINE_START_S = 0.1\n");
        return CrgRoad(parsed_crg(changed(text, "$ROAD_CRG ", "$ROAD_CRG_MODS\n" + mods + "$\n$ROAD_CRG ")));
    };
    const std::string to = "REFPOINT_X = 10\nREFPOINT_Y = 20\nREFPOINT_Z = 30\nREFPOINT_PHI = 1.5707963267948966\n";
    for (const std::string from : {"REFPOINT_U = 1\nREFPOINT_V = 0.5\n",
                                   "REFPOINT_U_FRACTION = 1\nREFPOINT_U_OFFSET = -2\nREFPOINT_V_FRACTION = 0.75\n"}) {
        const CrgRoad road = placed(from + to);
        EXPECT_NEAR(road.height(10.0, 20.0), 30, 1e-12) << from;
        EXPECT_NEAR(road.height(10.5, 20.0), 30 + 0.0222222 + 0.0111111, 1e-12) << "v = 0 lies to the right";
        EXPECT_NEAR(road.height(10.5, 21.0), 30.1 + 0.0111111, 1e-12) << "u goes along y";
    }
    EXPECT_NEAR(placed("REFPOINT_Z = 3\nREFLINE_OFFSET_X = 50\n").height(1.0, 0.0), 3 + 0.1 + 0.0222222, 1e-12)
        << "offsets are out of force";
}

// Part of a circle, and heights that end as they begin.
std::string circle(double part, const std::string& options) {
    const int segments = 40;
    std::string text = "$ROAD_CRG_OPTS\n" + options + R"($
$ROAD_CRG
REFERENCE_LINE_INCREMENT = 0.5
LONG_SECTION_V_INCREMENT = 2
LONG_SECTION_V_RIGHT = -1
$
$KD_DEFINITION
#:LDFI
D:reference line phi,rad
D:long section 1,m
D:long section 2,m
$
$$$$
)";
    for (int i = 0; i <= segments; ++i) {
        std::ostringstream row;
        row.precision(12);
        for (const double number : {2 * pi * part * (i - 0.5) / segments, std::cos(2 * pi * i / segments), 0.5})
            row << std::setw(20) << number;
        text += row.str() + "\n";
    }
    return text;
}

TEST(CrgFile, ContinuedWhereItCloses) {
    for (const std::string key : {"REFLINE_CONTINUATION = 1\n", "reference_line_continuation = 1.0\n"}) {
        const CrgDescription d = parsed_crg(circle(1, key + "BORDER_MODE_U = 0\n"));
        EXPECT_EQ(d.border_u, CrgBorder::repeat);
        const CrgRoad road(d);
        EXPECT_NEAR(road.height_uv(20.75, -1.0), road.height_uv(0.75, -1.0), 1e-12);
        EXPECT_NEAR(road.height_uv(-0.75, 1.0), road.height_uv(19.25, 1.0), 1e-12);
        for (const double x : {-0.2, -0.01, 0.0, 0.01, 0.2}) EXPECT_NEAR(road.height(x, -1.0), 1, 0.02) << x;
    }
    EXPECT_EQ(parsed_crg(circle(1, "REFLINE_CONTINUATION = 0\nBORDER_MODE_U = 0\n")).border_u, CrgBorder::none);
    const std::string in_road = changed(circle(1, ""), "$ROAD_CRG\n", "$ROAD_CRG\nREFERENCE_LINE_CONTINUATION = 1\n");
    EXPECT_EQ(parsed_crg(in_road).border_u, CrgBorder::repeat);
}

TEST(CrgFile, ContinuationOfAnOpenRoadMeansNothing) {
    for (const std::string key : {"REFLINE_CONTINUATION = 1\n", "REFERENCE_LINE_CONTINUATION = 1\n"}) {
        for (const double part : {0.0, 0.5, 0.9})
            EXPECT_EQ(parsed_crg(circle(part, key)).border_u, CrgBorder::keep) << key << part;
        EXPECT_EQ(parsed_crg(circle(0.5, key + "BORDER_MODE_U = 4\n")).border_u, CrgBorder::reflect);
        const std::string straight = changed(minimal_crg, "$ROAD_CRG ", "$ROAD_CRG_OPTS\n" + key + "$\n$ROAD_CRG ");
        EXPECT_EQ(parsed_crg(straight).border_u, CrgBorder::keep);
    }
}

}  // namespace
}  // namespace hamilcar::io
