// Result of a drive through a course, in words and numbers for the user.
#pragma once

#include <optional>
#include <vector>

#include "hamilcar/live/course_judge.hpp"

namespace hamilcar::live {

struct CourseVerdict {
    std::string criterion;       // "no cone is hit"
    std::optional<bool> passed;  // empty: not judged, because the car did not finish
    std::string found;           // "2 cones"; "" if there is nothing to report
};

struct CourseResult {
    bool finished = false;       // driven to its end
    std::optional<bool> passed;  // empty: there is no criterion
    std::vector<Figure> values;
    std::vector<CourseVerdict> verdicts;
    double time = 0;  // from the entry to the end, or to where the run ended [s]
};

CourseResult course_result(const Course& course, const CourseRun& run);

}  // namespace hamilcar::live
