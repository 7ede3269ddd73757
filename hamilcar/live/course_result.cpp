#include "hamilcar/live/course_result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "hamilcar/base/units.hpp"

namespace hamilcar::live {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

std::string count(int number, const char* one, const char* many) {
    return fmt::format("{} {}", number, number == 1 ? one : many);
}

}  // namespace

CourseResult course_result(const Course& course, const CourseRun& run) {
    CourseResult out{.finished = run.finished, .time = run.time};
    const auto add = [&](const char* name, const char* unit, const char* meaning, double value, bool known) {
        out.values.push_back({name, unit, meaning, known ? value : not_a_number});
    };
    const double mean_speed = run.distance / std::max(run.time, 1e-3), samples = std::max(run.samples, 1L);
    add("entry speed", "km/h", "", run.entry_speed / units::kilometer_per_hour, run.entered);
    add("exit speed", "km/h", "", run.exit_speed / units::kilometer_per_hour, run.finished);
    add("mean speed", "km/h", "along the line", mean_speed / units::kilometer_per_hour, run.finished);
    add("largest lateral acceleration", "m/s^2", "of the center of mass, either way", run.lateral_acceleration,
        run.samples > 0);
    if (course.cones.empty() && course.boundaries.empty()) {
        add("mean lateral acceleration", "m/s^2", "to the left positive", run.sum_acceleration / samples,
            run.samples > 0);
        add("mean deviation", "m", "of the center of mass from the line, either way", run.sum_offset / samples,
            run.samples > 0);
        return out;
    }
    // An unfinished run can fail a criterion, but it cannot pass one.
    const auto add_touched = [&](const char* criterion, int touched, const char* one, const char* many) {
        const bool judged = run.finished || touched > 0;
        out.verdicts.push_back({criterion, judged ? std::optional(touched == 0) : std::nullopt,
                                judged ? count(touched, one, many) : std::string()});
    };
    if (!course.boundaries.empty()) add_touched("no boundary is crossed", run.boundaries, "boundary", "boundaries");
    if (!course.cones.empty()) add_touched("no cone is hit", run.cones, "cone", "cones");
    out.verdicts.push_back({"driven through to the end", run.finished,
                            run.finished ? "" : fmt::format("{:.0f} m", std::max(run.distance, 0.0))});
    out.passed = std::ranges::all_of(out.verdicts, [](const CourseVerdict& one) { return one.passed == true; });
    return out;
}

}  // namespace hamilcar::live
