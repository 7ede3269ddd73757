// Judges how a person drives through a maneuver's course: the car's position between cones and boundaries is checked from the
// approach until its rear has left the course.
//
//     Course ─► line with stations ─► start, entry, end        Observation ─► CourseJudge ─► CourseRun, plain numbers for frames
//
// The car is represented by its bounding box on the ground, cones by points. A course without cones and boundaries is driven along
// its line; a line that returns to its beginning is a lap.
#pragma once

#include <string>
#include <vector>

#include "hamilcar/driver/observation.hpp"
#include "hamilcar/driver/path.hpp"
#include "hamilcar/maneuver/test_run.hpp"

namespace hamilcar::live {

// A course with the names that it is shown under.
struct TestCourse {
    std::string id;       // "double_lane_change"
    std::string name;     // short: "ISO 3888-1"
    std::string title;    // "Double lane change"
    std::string summary;  // one sentence by CourseJudge: the task and the criteria
    Course course;
};

// Measurements of the run so far.
struct CourseRun {
    bool entered = false, over = false;
    bool finished = false;                   // driven to its end
    int cones = 0, boundaries = 0;           // touched ones, each counted once
    double entry_time = 0, time = 0;         // when the front passes the entry; duration to the end, or so far [s]
    double entry_speed = 0, exit_speed = 0;  // [m/s]
    double distance = 0;                     // along the line since the entry [m]
    double lateral_acceleration = 0;         // largest magnitude [m/s^2]
    double sum_acceleration = 0;             // of lateral accelerations, to the left positive [m/s^2]
    double sum_offset = 0;                   // of distances of the center of mass from the line [m]
    long samples = 0;                        // number of terms in these sums
};

class CourseJudge {
public:
    // Throws std::invalid_argument if the line is not a valid path.
    CourseJudge(TestCourse course, const VehicleDescription& vehicle);

    const TestCourse& course() const { return course_; }
    // Initial pose of a car, heading along the line [m], [rad].
    struct Start {
        double x, y, yaw;
    };
    Start start() const;

    void begin();  // a new run; the car is at its start
    // To be called every few milliseconds; does not allocate.
    void update(const Observation& observation);
    void abort() { run_.over = true; }  // the car cannot continue
    const CourseRun& run() const { return run_; }

private:
    // A boundary and its position relative to the line.
    struct Side {
        Gate gate;
        double begin, end;  // stations [m]
        double inward;      // 1: the line is to its left, -1: to its right, 0: neither [1]
    };
    double station_of(double x, double y) const;
    Side side_of(const Gate& gate) const;
    bool touches(const Observation& observation, const std::array<double, 2>& from,
                 const std::array<double, 2>& to) const;
    bool is_beyond(const Observation& observation, const Side& side) const;
    void check_contacts(const Observation& observation);
    void update_run(const Observation& observation, double station, double offset);

    TestCourse course_;
    Footprint box_;
    Path path_;
    std::vector<Side> sides_;
    double entry_ = 0, end_ = 0;  // stations [m]

    CourseRun run_;
    std::vector<char> cones_, crossed_;  // whether touched
    bool has_previous_ = false;
    double station_ = 0;  // of the center of mass, at the last update [m]
    Observation last_;
};

}  // namespace hamilcar::live
