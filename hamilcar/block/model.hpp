// What the four blocks share and never change: the car, the road, and the form of the equations.
#pragma once

#include "hamilcar/description/scenario.hpp"
#include "hamilcar/road/plane.hpp"
#include "hamilcar/road/surface.hpp"
#include "hamilcar/scalar/dispatch.hpp"
#include "hamilcar/vehicle/chart.hpp"
#include "hamilcar/vehicle/state.hpp"

namespace hamilcar {

template <class T>
struct Model {
    Vehicle<T> vehicle;
    PlaneRoad<T> road;
    const Surface* surface = nullptr;  // of an uneven road, else null; owned by the caller
    ChassisChart chart = ChassisChart::quaternion;
    ConstraintMode constraints = ConstraintMode::exact;
    T stabilization_gain{0};     // alpha of (27) [1/s]; zero in exact mode
    bool energy_balance = true;  // integrate the work as well, so that every run can check its energy balance
};

// The driver's inputs at one instant.
template <class T>
struct Input {
    RackMotion<T> rack;
    T drive_torque{0};       // at the driven wheels together [N m]
    T brake{0};              // command, 0 to 1
    double time = 0;         // for roads that move [s]
    T throttle{0};           // pedal of the power units, 0 to 1
    T clutch{0};             // pedal, 0 released to 1 pressed
    T gear{0};               // -1 reverse, 0 neutral, 1 first, ...; in between during a shift
    T wind_x{0}, wind_y{0};  // velocity of the air, ground axes [m/s]
    // Where the steering has a rack that moves on its own: how firmly the hands hold the steering wheel where `rack` is asked for, from 0,
    // hands off, to 1, and the torque that they apply besides [N m].
    T hands_hold{1}, hands_torque{0};
    T parking_brake{0};  // lever, 0 to 1
    // What controllers tell actuators (vehicle/command_layout.hpp), kept by who makes the input; null: all at rest.
    const T* commands = nullptr;
};

// Calls f with the model's chart object.
template <class T, class F>
decltype(auto) with_chart(const Model<T>& model, F&& f) {
    return model.chart == ChassisChart::quaternion ? f(QuaternionChart<T>{}) : f(BryantChart<T>{});
}

}  // namespace hamilcar
