// What the text of a new vehicle needs, and the text.
#pragma once

#include <numbers>
#include <string>

#include "hamilcar/template/axle_text.hpp"
#include "hamilcar/template/vehicle_template.hpp"

namespace hamilcar {

inline constexpr double gravity = 9.80665;
inline constexpr double deflection_share = 0.06;  // of the tire's radius, under its load

// Everything that the text needs; the second half is found by the kinematics of the first.
struct VehicleSizes {
    const TemplateRequest* request;
    AxleSizes front, rear;
    double tire_load, tire_stiffness;  // the mean one [N], [N/m]
    double rack_per_revolution = 0.05, rack_travel = 0.15;

    const ClassValues& values() const { return request->values; }
    double load(const AxleSizes& axle) const {  // of one wheel
        const double share = axle.is_front ? values().front_load : 1 - values().front_load;
        return values().mass * gravity * share / 2;
    }
    double carried(const AxleSizes& axle) const {  // by one spring [kg]
        return load(axle) / gravity - unsprung_mass(axle) / 2;
    }
    double wheel_rate(const AxleSizes& axle) const {  // the load on its springs, as `hamilcar check` has it
        const double ride = 2 * std::numbers::pi * (axle.is_front ? values().front_ride : values().rear_ride);
        return load(axle) / gravity * ride * ride;
    }
};

std::string vehicle_text(const VehicleSizes& sizes);

}  // namespace hamilcar
