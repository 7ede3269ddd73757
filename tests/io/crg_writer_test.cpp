// OpenCRG files that are written read back to the precision of their form.
#include <cmath>
#include <limits>
#include <tuple>

#include "hamilcar/io/crg_file.hpp"
#include "hamilcar/road/crg_road.hpp"
#include "io/files.hpp"

namespace hamilcar::io {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

CrgDescription sample(bool curved, bool even) {
    CrgDescription d;
    d.u_start = 5, d.u_increment = 0.1, d.x = 100.5, d.y = -7.25, d.z = 12.125, d.phi = 0.3;
    d.v =
        even ? std::vector<double>{-1.5, -1, -0.5, 0, 0.5, 1, 1.5, 2, 2.5} : std::vector<double>{-2, -0.3, 0, 0.1, 3.7};
    for (int i = 0; i < 50; ++i)
        for (const double v : d.v) d.heights.push_back(0.03 * std::sin(0.7 * i) * std::cos(v) + 1e-5 * i);
    d.heights[0] = d.heights[1] = d.heights.back() = nan;
    for (int i = 0; curved && i < 49; ++i) {
        d.headings.push_back(0.3 + 0.01 * i);
        d.slopes.push_back(0.05 * std::sin(0.1 * i));
    }
    for (int i = 0; curved && i < 50; ++i) d.bankings.push_back(0.02 * std::cos(0.1 * i));
    if (!curved) d.slope = 0.04, d.banking = -0.03;
    d.border_u = CrgBorder::repeat, d.border_v = CrgBorder::none;
    d.border_offset_u = 0.5, d.smooth_end = 0.7;
    d.missing = CrgMissing::zero, d.missing_offset = -0.2;
    if (curved) {
        double x = d.x, y = d.y, z = d.z;
        for (int i = 0; i < 49; ++i) {
            const auto k = static_cast<std::size_t>(i);
            x += 0.1 * std::cos(d.headings[k]), y += 0.1 * std::sin(d.headings[k]), z += 0.1 * d.slopes[k];
        }
        d.end_x = x + 1e-3, d.end_y = y, d.end_z = z - 1e-3;
    }
    return d;
}

void expect_near(const std::vector<double>& read, const std::vector<double>& written, double precision) {
    ASSERT_EQ(read.size(), written.size());
    for (std::size_t i = 0; i < read.size(); ++i) {
        EXPECT_EQ(std::isnan(read[i]), std::isnan(written[i])) << i;
        if (std::isnan(written[i])) continue;
        EXPECT_NEAR(read[i], written[i], precision * std::max(1.0, std::abs(written[i])));
    }
}

// To 7 digits after the point or more, all of a double's but the last, half a bit of a float, and all.
TEST(CrgWriter, WrittenReadsBack) {
    const TemporaryFolder folder;
    const std::vector<std::pair<CrgFormat, double>> forms{{CrgFormat::long_ascii_single, 6e-8},
                                                          {CrgFormat::long_ascii_double, 1e-13},
                                                          {CrgFormat::binary_single, std::ldexp(1, -24)},
                                                          {CrgFormat::binary_double, 0}};
    for (const auto& [format, precision] : forms)
        for (const bool curved : {false, true})
            for (const bool even : {false, true}) {
                SCOPED_TRACE(static_cast<int>(format) * 10 + curved * 2 + even);
                const CrgDescription d = sample(curved, even);
                write_crg(d, folder / "road.crg", format);
                const CrgDescription read = read_crg(folder / "road.crg");
                EXPECT_EQ(std::tuple(read.u_start, read.u_increment, read.x, read.y, read.z, read.smooth_end),
                          std::tuple(d.u_start, d.u_increment, d.x, d.y, d.z, d.smooth_end));
                EXPECT_EQ(std::tuple(read.end_x, read.end_y, read.end_z), std::tuple(d.end_x, d.end_y, d.end_z));
                EXPECT_EQ(std::tuple(read.border_u, read.border_v, read.border_offset_u, read.border_offset_v),
                          std::tuple(d.border_u, d.border_v, d.border_offset_u, d.border_offset_v));
                EXPECT_EQ(std::tuple(read.missing, read.missing_offset), std::tuple(d.missing, d.missing_offset));
                EXPECT_NEAR(read.phi, 0.3, precision);
                EXPECT_NEAR(read.slope, curved ? d.slopes[0] : d.slope, precision);
                EXPECT_NEAR(read.banking, curved ? d.bankings[0] : d.banking, precision);
                expect_near(read.headings, d.headings, precision);
                expect_near(read.slopes, d.slopes, precision);
                expect_near(read.bankings, d.bankings, precision);
                expect_near(read.v, d.v, 1e-15);
                expect_near(read.heights, d.heights, precision);
                for (const auto& point : {CrgPoint{102, -6}, CrgPoint{103.1, -5.9}})
                    EXPECT_NEAR(CrgRoad(read).height(point.x, point.y), CrgRoad(d).height(point.x, point.y), 1e-5);
            }
}

TEST(CrgWriter, BinaryComesInWholeRecords) {
    const TemporaryFolder folder;
    write_crg(sample(true, true), folder / "road.crg", CrgFormat::binary_single);
    const std::string text = read_file(folder / "road.crg"), mark = "\n$$$$\n";
    EXPECT_EQ((text.size() - text.find(mark) - mark.size()) % 80, 0U);
}

TEST(CrgWriter, Unwritable) {
    const TemporaryFolder folder;
    expect_error([&] { write_crg(sample(true, true), folder / "no/road.crg", CrgFormat::binary_single); },
                 ExitCode::input_output, {"cannot write"});
}

}  // namespace
}  // namespace hamilcar::io
