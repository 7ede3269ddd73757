// The units a property file says it is written in, as factors to SI. Only what stands in `[UNITS]` is a unit: the MASS
// of `[INERTIA]` or `[VEHICLE]` is a mass.
#pragma once

#include <string_view>
#include <vector>

#include "hamilcar/io/property_file.hpp"

namespace hamilcar::io {

// A number of the file times its factor is the quantity in SI.
struct PropertyUnits {
    double length = 1;                     // [m]
    double force = 1;                      // [N]
    double angle = 1;                      // [rad]
    double mass = 1;                       // [kg]
    double time = 1;                       // [s]
    double pressure = 1;                   // [Pa]
    double temperature = 1;                // [K], of a difference
    double temperature_offset = 0;         // [K], of what the file calls 0
    std::vector<std::string_view> absent;  // of LENGTH, FORCE, ANGLE, MASS and TIME: these are taken as SI

    double velocity() const { return length / time; }                      // [m/s]
    double stiffness() const { return force / length; }                    // [N/m]
    double damping() const { return force * time / length; }               // [N s/m]
    double moment() const { return force * length; }                       // [N m]
    double rotational_stiffness() const { return moment() / angle; }       // [N m/rad]
    double rotational_damping() const { return moment() * time / angle; }  // [N m s/rad]
    double cornering_stiffness() const { return force / angle; }           // [N/rad]
    double inertia() const { return mass * length * length; }              // [kg m^2]
};

// PRESSURE and TEMPERATURE are Pa and K if the file does not say otherwise; few files do, so they are never `absent`.
// Throws Error(bad_file, "path:line: ...") at an unknown unit.
PropertyUnits units_of(const PropertyFile& file);

}  // namespace hamilcar::io
