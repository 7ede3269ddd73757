// A driver who goes through a course of lanes again and again, each time with what he learned from the time before.
#pragma once

#include "hamilcar/maneuver/lane_change.hpp"
#include "hamilcar/maneuver/runs.hpp"

namespace hamilcar {

struct CourseDrive {
    double speed;  // at the start [km/h]
    Trial trial;
    Passage passage;
};

class CourseDriver {
public:
    // `speeds`: as many as will be driven at most, for the maneuver's progress.
    CourseDriver(const VehicleDescription& vehicle, const LaneChange& change, const Settings& settings,
                 const ManeuverOptions& options, int speeds);

    const Course& course() const { return course_; }
    bool may_go_on() const { return driven_ < speeds_; }

    // At a speed [km/h], until an attempt is clean; the best one counts. What the others took is added to the outcome's energy.
    // An attempt that breaks off is returned at once.
    CourseDrive drive(double speed, bool film, Outcome& outcome);

private:
    using Line = std::vector<std::array<double, 2>>;
    CourseDrive attempt(double speed, const Line& line, bool film, std::function<bool(double)> keep_going) const;
    Line corrected(Line line, const History& history) const;

    const VehicleDescription& vehicle_;
    const LaneChange& change_;
    const ManeuverOptions& options_;
    Footprint box_;
    Course course_;
    double preview_;  // [s]
    int attempts_, speeds_, driven_ = 0;
};

}  // namespace hamilcar
