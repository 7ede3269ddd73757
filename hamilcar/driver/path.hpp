// The line that a driver follows: a cubic spline through points, with continuous heading and curvature.
//
// Natural at open ends, which run on straight, so that the curvature is continuous there too; periodic where closed. Its knots
// are spaced by chords; a station is true arc length, by Gauss's quadrature of the spline's speed. Queries allocate nothing and
// give the same bits on every machine.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "hamilcar/description/driver.hpp"

namespace hamilcar {

// A point of the path, with its direction as a unit vector.
struct PathPoint {
    double x = 0, y = 0;                  // [m]
    double tangent_x = 1, tangent_y = 0;  // [1]
    double curvature = 0;                 // to the left positive [1/m]
    double heading() const;               // within (-pi, pi] [rad]
};

// Where something stands beside the path.
struct PathPlace {
    double station = 0;  // of the nearest point [m]; grows beyond the length with every lap of a closed path
    double offset = 0;   // from there, to the left positive [m]
};

class Path {
public:
    Path() = default;
    // Throws std::invalid_argument on too few points, points in one place or where nobody drives, a path that turns back on
    // itself, and numbers that are none.
    explicit Path(const PathDescription& description);

    bool closed() const { return closed_; }
    double length() const { return station_.empty() ? 0 : station_.back(); }  // once around, where closed [m]
    PathPoint at(double station) const;
    // Goes downhill in distance from a remembered station, or from one shortly ahead of it that is nearer: a car that cuts a
    // hairpin is never left behind in it.
    PathPlace nearest(double x, double y, double remembered) const;
    // Without a memory: of all stretches that lead about where the car heads, the nearest; the first of equals.
    PathPlace nearest_of_all(double x, double y, double yaw) const;

private:
    // Over one stretch p0 + u (p1 + u (p2 + u p3)), u from 0 to the chord.
    struct Stretch {
        std::array<double, 4> x, y;
        double chord;  // [m]
    };
    // The spline and its derivatives by the parameter, at u of a stretch.
    struct Local {
        double x, y, dx, dy, ddx, ddy;
    };
    // A stretch and u within it; of an open path the ends run on straight, u below 0 or above the chord.
    struct Parameter {
        std::size_t stretch;
        double u;
        int lap;
    };
    static Local local(const Stretch& stretch, double u);
    static double arc(const Stretch& stretch, double u);
    bool is_beyond(const Parameter& at) const;
    Local local(const Parameter& at) const;
    Parameter parameter(double station) const;
    double station(const Parameter& at) const;
    Parameter moved(Parameter at, double by) const;
    PathPlace descend(double x, double y, Parameter at) const;

    std::vector<Stretch> stretches_;
    std::vector<double> station_;  // of the knots, one more than stretches [m]
    bool closed_ = false;
};

}  // namespace hamilcar
