// What came out of a drive through a course, in words and numbers for a person.
#pragma once

#include <optional>
#include <vector>

#include "hamilcar/live/course_judge.hpp"

namespace hamilcar::live {

struct CourseVerdict {
    std::string criterion;       // "no cone is hit"
    std::optional<bool> passed;  // empty: not judged, because the car never came to the end
    std::string found;           // "2 cones"; "" where there is nothing to tell
};

struct CourseResult {
    bool finished = false;       // driven to its end
    std::optional<bool> passed;  // empty: there is nothing to pass
    std::vector<Figure> values;
    std::vector<CourseVerdict> verdicts;
    double time = 0;  // from the entry to the end, or as far as it went [s]
};

CourseResult course_result(const Course& course, const CourseRun& run);

}  // namespace hamilcar::live
