// The tables of one axle of a new vehicle.
#pragma once

#include <string>
#include <vector>

#include "hamilcar/suspension/recipe.hpp"

namespace hamilcar {

// "key = value", its comment where the others are.
std::string line(const std::string& key, const std::string& value, const std::string& comment = "");
// A number as people write it, to four digits.
std::string number(double value);
std::string point(const Point& p);

// What is known of an axle before its linkage is, and what follows from that.
struct AxleSizes {
    const Recipe* recipe = nullptr;
    bool is_front = false;
    Point wheel{};            // its center, left
    double mass = 0;          // of the whole vehicle [kg]
    double spring_rate = 0;   // of one spring [N/m]
    double damping = 0;       // of one damper [N s/m]
    double bar_rate = 0;      // of wheel travel difference [N/m]; 0: no bar
    double brake_torque = 0;  // of one wheel [N m]
    double drive_share = 0;   // of a prescribed torque
    double spin_inertia = 0;  // of one wheel [kg m^2]
    double tire_radius = 0;   // unloaded [m]

    const char* name() const { return is_front ? "front" : "rear"; }
};

// What moves with the wheels: rods are without mass here. One off the middle plane has its mirror image.
struct AxleBody {
    std::string table, what;
    double mass;   // [kg]
    Point center;  // [m]
    Point radii;   // of inertia about it [m]

    int copies() const { return center[1] == 0 ? 1 : 2; }
};
std::vector<AxleBody> bodies_of(const AxleSizes& axle);
double unsprung_mass(const AxleSizes& axle);  // [kg]

std::string axle_text(const AxleSizes& axle);

}  // namespace hamilcar
