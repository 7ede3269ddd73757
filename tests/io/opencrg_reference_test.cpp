// OpenCRG's sample files, whole and changed, against ASAM's own library: what it refuses is refused, and heights are its heights.
#include <cmath>
#include <fstream>
#include <sstream>

#include "hamilcar/io/crg_file.hpp"
#include "hamilcar/road/crg_road.hpp"
#include "io/files.hpp"
#include "support/paths.hpp"

namespace hamilcar::io {
namespace {

const std::string folder = "tests/io/opencrg/";

struct Point {
    double x, y, height;  // [m]; NaN: none
};

struct Case {
    std::string file, section, insertion;
    bool refused = false;
    std::vector<Point> points;

    std::string path() const { return test::source_path(folder + file); }
    std::string text() const {
        std::string all = read_file(path());
        std::string lines = insertion;
        std::ranges::replace(lines, ';', '\n');
        if (!section.empty()) all.insert(all.find("$KD_"), "$" + section + "\n" + lines + "\n$\n");
        return all;
    }
};

std::vector<Case> read_cases() {
    std::vector<Case> cases;
    std::ifstream in(test::source_path(folder + "heights.txt"));
    for (std::string line; std::getline(in, line);) {
        std::istringstream words(line);
        std::string first;
        words >> first;
        if (first == "file") {
            words >> cases.emplace_back().file;
        } else if (first == "insert") {
            words >> cases.back().section;
            std::getline(words >> std::ws, cases.back().insertion);
        } else if (first == "refused") {
            cases.back().refused = true;
        } else {
            std::string y, height;
            words >> y >> height;
            cases.back().points.push_back(
                {std::stod(first), std::stod(y), height == "none" ? std::nan("") : std::stod(height)});
        }
    }
    return cases;
}

// The library keeps heights as single numbers.
CrgRoad with_single_heights(CrgDescription d) {
    for (double& height : d.heights) height = static_cast<double>(static_cast<float>(height));
    return CrgRoad(d);
}

void expect_heights(const CrgRoad& road, const std::vector<Point>& points, double tolerance) {
    for (const Point& p : points) {
        SCOPED_TRACE(testing::Message() << p.x << " " << p.y);
        if (std::isnan(p.height))
            EXPECT_FALSE(road.covers(p.x, p.y));
        else
            EXPECT_NEAR(road.height(p.x, p.y), p.height, tolerance);
    }
}

TEST(OpencrgReference, LoadsRefusesAndEvaluatesAsTheLibrary) {
    const std::vector<Case> cases = read_cases();
    ASSERT_GT(cases.size(), 50U);
    for (const Case& one : cases) {
        SCOPED_TRACE(one.file + " " + one.section + " " + one.insertion);
        if (one.refused) {
            EXPECT_THROW(parse_crg(one.text(), one.path()), Error);
            continue;
        }
        ASSERT_FALSE(one.points.empty());
        expect_heights(with_single_heights(parse_crg(one.text(), one.path())), one.points, 1e-8);
    }
}

// ASAM's binary samples are made of megabytes: their header with fewer rows is among the files above, and here the text ones are
// written in every form.
TEST(OpencrgReference, EveryFormHasTheSameHeights) {
    const TemporaryFolder written;
    for (const Case& one : read_cases()) {
        if (one.refused || !one.section.empty() || one.file.starts_with("crg-bin")) continue;
        SCOPED_TRACE(one.file);
        const CrgDescription d = parse_crg(one.text(), one.path());
        for (const CrgFormat form : {CrgFormat::long_ascii_single, CrgFormat::long_ascii_double,
                                     CrgFormat::binary_single, CrgFormat::binary_double}) {
            SCOPED_TRACE(static_cast<int>(form));
            write_crg(d, written / "road.crg", form);
            // A heading rounded to single bends the line; the samples have headings of seven digits.
            const double tolerance = form == CrgFormat::binary_single ? 1e-6 : 1e-8;
            expect_heights(with_single_heights(read_crg(written / "road.crg")), one.points, tolerance);
        }
    }
}

TEST(OpencrgReference, SamplesLeaveNoRemarksButThose) {
    const auto remarks = [](const std::string& file) {
        return read_crg(test::source_path(folder + "crg-txt/" + file)).remarks;
    };
    EXPECT_THAT(remarks("handmade_straight.crg"), testing::IsEmpty());
    EXPECT_THAT(remarks("fileref.crg"), testing::IsEmpty());
    EXPECT_THAT(remarks("handmade_sloped_opts.crg"),
                testing::ElementsAre(testing::HasSubstr(":81: key 'log_eval' is in line 79 too: the later one counts"),
                                     testing::HasSubstr("'log_eval_freq'")));
    EXPECT_THAT(remarks("handmade_platform.crg"),
                testing::ElementsAre(testing::HasSubstr("key 'grid_nan_mode' = '2.000000000+e00' is read as 2.0")));
    EXPECT_THAT(remarks("handmade_straight_minimalist.crg"),
                testing::ElementsAre(testing::HasSubstr("'long_section_v_right' is missing")));
}

}  // namespace
}  // namespace hamilcar::io
