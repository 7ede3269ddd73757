// What the four blocks share and never change: the car, the road, and how the equations are to be integrated.
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
    const Surface* surface = nullptr;  // what stands on the plane, if anything does; whoever makes a model keeps it
    ChassisChart chart = ChassisChart::quaternion;
    ConstraintMode constraints = ConstraintMode::exact;
    T stabilization_gain{0};     // alpha of (27) [1/s]; zero in exact mode
    bool energy_balance = true;  // integrate the work along, so that every run can check itself
};

// What the driver does at one instant.
template <class T>
struct Input {
    RackMotion<T> rack;
    T drive_torque{0};  // at the driven wheels together [N m]
    T brake{0};         // command, 0 to 1
    double time = 0;    // for roads that move [s]
    T throttle{0};      // pedal of the power units, 0 to 1
    T clutch{0};        // pedal, 0 released to 1 pressed
    T gear{0};          // -1 reverse, 0 neutral, 1 first, ...; between two while a gearbox passes from one to the next
    T wind_x{0}, wind_y{0};  // velocity of the air, ground axes [m/s]
};

// Calls f with the chart object the model names.
template <class T, class F>
decltype(auto) with_chart(const Model<T>& model, F&& f) {
    return model.chart == ChassisChart::quaternion ? f(QuaternionChart<T>{}) : f(BryantChart<T>{});
}

}  // namespace hamilcar
