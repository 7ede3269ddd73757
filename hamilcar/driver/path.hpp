// The line that a driver follows: a cubic spline through points, with continuous heading and curvature.
//
// Open ends are natural and continue straight, so that the curvature is continuous there too; closed paths are periodic. The
// spline parameter is chord length; stations are true arc length, by Gauss quadrature of the spline's speed. Queries allocate
// nothing and give the same bits on every machine.
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
    double curvature = 0;                 // positive to the left [1/m]
    double heading() const;               // within (-pi, pi] [rad]
};

// A position relative to the path.
struct PathPlace {
    double station = 0;  // of the nearest point [m]; grows beyond the length with every lap of a closed path
    double offset = 0;   // from there, positive to the left [m]
};

class Path {
public:
    Path() = default;
    // Throws std::invalid_argument on too few points, coincident or very distant points, a path that turns back on itself, and
    // coordinates that are not numbers.
    explicit Path(const PathDescription& description);

    bool closed() const { return closed_; }
    double length() const { return station_.empty() ? 0 : station_.back(); }  // once around, where closed [m]
    PathPoint at(double station) const;
    // Minimizes the distance, starting from a remembered station or from a nearer one shortly ahead of it, so that a car that
    // cuts a hairpin is not lost.
    PathPlace nearest(double x, double y, double remembered) const;
    // Without a remembered station: the nearest point of all stretches whose direction is within 90 degrees of the car's
    // heading; the first if several are equally near.
    PathPlace nearest_of_all(double x, double y, double yaw) const;

private:
    // One stretch: p0 + u (p1 + u (p2 + u p3)), with u from 0 to the chord.
    struct Stretch {
        std::array<double, 4> x, y;
        double chord;  // [m]
    };
    // The spline and its derivatives with respect to u, at one u of a stretch.
    struct Local {
        double x, y, dx, dy, ddx, ddy;
    };
    // A stretch and u within it; u is below 0 or above the chord on the straight extensions of an open path.
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
