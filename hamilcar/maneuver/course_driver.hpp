// A driver that goes through a course of lanes again and again, each time with what the drive before has taught.
#pragma once

#include "hamilcar/maneuver/lane_change.hpp"

namespace hamilcar {

struct CourseDrive {
    double speed;  // at the start [km/h]
    Drive drive;
    Passage passage;
};

class CourseDriver {
public:
    // `speeds`: as many as will be driven at most, for the maneuver's progress.
    CourseDriver(TestRun& test, const LaneChange& change, int speeds);

    const Course& course() const { return course_; }
    bool may_go_on() const { return driven_ < speeds_; }

    // At a speed [km/h], until an attempt is clean; the best one counts. What the others took is added to the outcome's energy.
    // An attempt that breaks off is returned at once.
    CourseDrive drive(double speed);

private:
    using Line = std::vector<std::array<double, 2>>;
    CourseDrive attempt(double speed, const Line& line, Share share) const;
    Line corrected(Line line, const Recording& recording) const;

    TestRun& test_;
    const LaneChange& change_;
    Footprint box_;
    Course course_;
    int speeds_, driven_ = 0;
};

}  // namespace hamilcar
