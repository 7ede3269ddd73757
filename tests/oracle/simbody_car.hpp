// The same car in another engine: Simbody integrates the description with coordinates and multipliers of its own.
//
// Nothing of hamilcar but the plain description is used here; the forces come from the page docs/models/forces.md.
// Paths that agree with these agree with an independent derivation, an independent solver and a second reading of the
// page.
#pragma once

#include "hamilcar/description/vehicle.hpp"

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace hamilcar::oracle {

// What the driver imposes at one instant. The three rack values are one motion and its time derivatives.
struct Inputs {
    double rack = 0;               // displacement along each tie rod's rack axis [m]
    double rack_rate = 0;          // [m/s]
    double rack_acceleration = 0;  // [m/s^2]
    double drive_torque = 0;       // at the differential's output, before the shares [N m]
    double brake = 0;              // command, 0 to 1
};

struct TireState {
    double u = 0, v = 0;  // contact deflections, along and across [m]
};

struct WheelState {
    double spin = 0;               // relative to the carrier [rad/s]
    double b = 0;                  // brake wind-up [rad]
    std::vector<TireState> tires;  // one, or two (dual tires): the first toward the spin axis
};

// A suspension: all coordinates of its description's tree in order, the dependent ones as well [m, rad].
struct TreeState {
    std::vector<double> coordinates, rates;
    std::vector<WheelState> wheels;
};

struct HitchState {
    std::vector<double> angles, rates;  // ball: about z, x', y''; fifth wheel: about z, y' [rad, rad/s]
};

struct CarState {
    std::array<double, 3> position{};                           // vehicle frame's origin, ground axes [m]
    std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};  // row-major, vehicle axes to ground
    std::array<double, 3> velocity{};                           // of that origin, ground axes [m/s]
    std::array<double, 3> angular_velocity{};                   // of the chassis, ground axes [rad/s]
    std::vector<TreeState> suspensions;                         // as in the description
    std::vector<HitchState> trailers;                           // likewise
};

// The plane z = grade x + bank y.
struct Road {
    double grade = 0, bank = 0;
    double friction = 1;  // factor on the tires' own
};

// How a MacPherson spindle moves. Free in space, with every joint a constraint, it shares the least with hamilcar. On
// its strut, in relative coordinates, with Simbody's constraints as arms and tie rods and prescribed racks, it is what
// a user of Simbody would build. One constraint for the whole car in place of all those, and of the racks, is faster.
enum class SpindleModel {
    free,                  // 26 speeds and 10 multipliers for a car with two struts and two arms
    strut,                 // 22 and 6
    strut_one_constraint,  // 20 and 6
};

class SimbodyCar {
public:
    // Throws std::invalid_argument where the description has a body that Simbody cannot move: one without mass at the
    // end of its tree, or a carrier whose inertia has no room for the wheel's.
    SimbodyCar(const VehicleDescription& description, const Road& road,
               SpindleModel spindle_model = SpindleModel::free);
    ~SimbodyCar();

    // For the calls that are not given any; zero until told. `advance` and `evaluate_accelerations_once` leave
    // their last inputs here.
    void set_inputs(const Inputs& inputs);

    // The coordinates of suspensions need only be near closed loops with the current rack input: they and their rates are
    // projected on them. Throws std::out_of_range if a suspension, wheel, coordinate or trailer is missing.
    void set_state(const CarState& state);

    CarState state() const;

    // Where a point of the motor vehicle (unit 0) or of a trailer's chassis (from 1 on) is, in ground axes [m]; the
    // point as in the description.
    std::array<double, 3> ground_point(std::size_t unit, const Point& point) const;

    // Kinetic, and the potentials of gravity, springs, bars, stops and vertical tire stiffness [J].
    double energy() const;

    // Classical Runge-Kutta of order four with a fixed step; coordinates and speeds are projected on the constraints
    // after each step. `inputs` is called with t0, t0 + h/2, t0 + h, ... and, as the rack's acceleration may jump
    // between two steps, just inside the ends of each.
    void advance(double t0, double h, int steps, const std::function<Inputs(double)>& inputs);

    // One full evaluation of the equations of motion at the current state; the norm of the accelerations.
    double evaluate_accelerations_once(const Inputs& inputs);

    // Largest residual of the constraints and of their time derivatives [m, m^2, m/s, m^2/s].
    double worst_constraint_error() const;

private:
    struct Engine;
    std::unique_ptr<Engine> engine_;
};

}  // namespace hamilcar::oracle
