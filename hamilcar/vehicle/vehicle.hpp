// The constants of a car: a hub (the chassis) and its spokes, each a suspension with what hangs on it. Built once from a
// description, never changed by a step.
#pragma once

#include <array>
#include <vector>

#include "hamilcar/driveline/brake.hpp"
#include "hamilcar/force/axial.hpp"
#include "hamilcar/force/hull.hpp"
#include "hamilcar/suspension/list.hpp"
#include "hamilcar/tire/list.hpp"

namespace hamilcar {

// A wheel turns about an axis of its carrier; only its spin inertia is its own, the rest counts with the carrier.
template <class T>
struct Wheel {
    Vec3<T> center, axis;  // at design [m], unit
    T spin_inertia;        // [kg m^2]
};

template <class T>
struct Spoke {
    Suspension<T> suspension;
    RigidBody<T> carrier;
    Wheel<T> wheel;
    Spring<T> spring;
    Damper<T> damper;
    Stop<T> bump, rebound;
    Tire<T> tire;
    Brake<T> brake;
    T drive_share;                 // of the drive torque [1]
    T inverse_design_determinant;  // 1 / det Phi_w at design, the measure of the linkage's mobility
};

template <class T>
struct AntiRollBar {
    int left, right;  // spokes
    T rate;           // [N/m] of wheel travel difference
};

template <class T>
struct Aerodynamics {
    T half_density_area;  // rho C_d A / 2 [kg/m]
    Vec3<T> center;       // [m]
};

template <class T>
struct Vehicle {
    RigidBody<T> chassis;
    SpatialInertia<T> chassis_inertia;  // about the vehicle origin
    std::vector<Spoke<T>> spokes;
    std::vector<AntiRollBar<T>> anti_roll_bars;
    Aerodynamics<T> aerodynamics;
    Hull<T> hull;
    T gravity;     // [m/s^2]
    T total_mass;  // [kg]

    explicit Vehicle(const VehicleDescription& description);
    int spoke_count() const { return static_cast<int>(spokes.size()); }
};

}  // namespace hamilcar

#include "hamilcar/vehicle/build.hpp"
