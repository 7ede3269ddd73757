// A road surface in the terms of OpenCRG (curved regular grid): heights on a grid that follows a reference line. u runs
// along the line, v across it, positive to the left of the direction of u. All SI, angles in radians.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace hamilcar {

// What stands beyond the grid, OpenCRG's border modes 0 to 4: nothing, the height zero, the height of the grid's edge,
// the grid again, the grid mirrored.
enum class CrgBorder { none, zero, keep, repeat, reflect };

// What stands for a height that is missing inside the grid, OpenCRG's grid_nan_mode 0 to 2: nothing, zero, the last one
// present in the same cross section.
enum class CrgMissing { none, zero, keep };

struct CrgDescription {
    double u_start = 0, u_increment = 0.01;  // [m]; u ends where the rows of heights do
    double x = 0, y = 0, z = 0;              // of the reference line at u_start [m]
    double phi = 0;      // heading there, from x toward y [rad]; of all the line if `headings` is empty
    double slope = 0;    // rise of the line over its run [1], if `slopes` is empty
    double banking = 0;  // rise over run to the left [1], if `bankings` is empty

    // One less than rows: from row i to row i + 1. Headings [rad], slopes [1].
    std::vector<double> headings, slopes;
    std::vector<double> bankings;  // one per row [1]

    // Where a curved line, or one whose slope varies, is known to end [m]: what the sum of its rounded headings and
    // slopes misses by is spread along it. x and y come together.
    std::optional<double> end_x, end_y, end_z;

    std::vector<double> v;        // of the longitudinal sections, rising from right to left [m]
    std::vector<double> heights;  // row after row, v.size() per row [m]; NaN where there is none

    CrgBorder border_u = CrgBorder::keep, border_v = CrgBorder::keep;
    double border_offset_u = 0, border_offset_v = 0;  // added beyond the grid where the border is `zero` or `keep` [m]
    double smooth_start = 0, smooth_end = 0;  // over which the surface rises out of the line's height at that end [m]
    CrgMissing missing = CrgMissing::keep;
    double missing_offset = 0;  // added to what stands for missing heights [m]

    std::vector<std::string> remarks;  // of who read the file: what is not used, or used in spite of a contradiction

    std::size_t columns() const { return v.size(); }
    std::size_t rows() const { return v.empty() ? 0 : heights.size() / v.size(); }
    double u_end() const { return rows() == 0 ? u_start : u_start + static_cast<double>(rows() - 1) * u_increment; }
};

}  // namespace hamilcar
