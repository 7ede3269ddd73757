// How a person drives through a maneuver's course: where the car stands between cones and boundaries, watched from its
// approach until the whole of it has come out.
//
//     Course ─► line with stations ─► start, entry, end        Senses ─► CourseJudge ─► CourseRun, plain numbers for frames
//
// The car is the box around it on the ground, cones are points. A course without any of them is driven through along its line
// alone; a line that returns to its beginning is a lap.
#pragma once

#include <string>
#include <vector>

#include "hamilcar/driver/path.hpp"
#include "hamilcar/driver/senses.hpp"
#include "hamilcar/maneuver/common.hpp"

namespace hamilcar::live {

// What is to be driven through, and what to call it.
struct TestCourse {
    std::string id;       // "double_lane_change"
    std::string name;     // short: "ISO 3888-1"
    std::string title;    // "Double lane change"
    std::string summary;  // one sentence: what to do, and what of it is judged; the judge's own
    Course course;
};

// What has been seen so far.
struct CourseRun {
    bool entered = false, over = false;
    bool finished = false;                   // driven to its end
    int cones = 0, boundaries = 0;           // that were touched, each counted once
    double entry_time = 0, time = 0;         // of the foremost point at the entry; at the end, or as far as it went [s]
    double entry_speed = 0, exit_speed = 0;  // [m/s]
    double distance = 0;                     // along the line since the entry [m]
    double lateral_acceleration = 0;         // largest, either way [m/s^2]
    double sum_acceleration = 0;             // of lateral accelerations, to the left positive [m/s^2]
    double sum_offset = 0;                   // of distances of the center of mass from the line [m]
    long looks = 0;                          // in these sums
};

class CourseJudge {
public:
    // Throws std::invalid_argument where the line is none.
    CourseJudge(TestCourse course, const VehicleDescription& vehicle);

    const TestCourse& course() const { return course_; }
    // Where a car stands that is to drive through, heading along the line [m], [rad].
    struct Start {
        double x, y, yaw;
    };
    Start start() const;

    void begin();  // the car is at its start
    // Again and again, a few milliseconds apart; without allocation.
    void look(const Senses& senses);
    void give_up() { run_.over = true; }  // the car cannot go on
    const CourseRun& run() const { return run_; }

private:
    // A boundary and where it stands beside the line.
    struct Side {
        Gate gate;
        double begin, end;  // stations [m]
        double inward;      // 1: the line is to its left, -1: to its right, 0: neither [1]
    };
    double station_of(double x, double y) const;
    Side side_of(const Gate& gate) const;
    bool touches(const Senses& senses, const std::array<double, 2>& from, const std::array<double, 2>& to) const;
    bool is_beyond(const Senses& senses, const Side& side) const;
    void look_around(const Senses& senses);
    void pass(const Senses& senses, double station, double offset);

    TestCourse course_;
    Footprint box_;
    Path path_;
    std::vector<Side> sides_;
    double entry_ = 0, end_ = 0;  // stations [m]

    CourseRun run_;
    std::vector<char> cones_, crossed_;  // whether touched
    bool begun_ = false;
    double station_ = 0;  // of the center of mass, at the last look [m]
    Senses last_;
};

}  // namespace hamilcar::live
