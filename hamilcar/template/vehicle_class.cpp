#include "hamilcar/template/vehicle_class.hpp"

#include "hamilcar/base/units.hpp"

namespace hamilcar {

using units::degree, units::percent, units::rpm;

namespace {

constexpr double standard_gravity = 9.80665;
constexpr double degree_per_g = degree / standard_gravity;

}  // namespace

std::span<const VehicleClass> vehicle_classes() {
    static const std::vector<VehicleClass> classes{
        {"hatchback",
         "compact hatchback, driver aboard",
         "hatchback",
         "macpherson",
         "twist_beam",
         DrivenWheels::front,
         {3.62, 1.95, 1.28, 0.97, 0.78, 0.65},
         {1300, 0.61,        0.54, 2.64,       1.54, 1.52, 4.26, 1.80, 1.45, 0.316, 1.25, 1.45, 5 * degree_per_g,
          15.6, 36 * degree, 175,  6200 * rpm, 4.06, 0.30, 1}},
        {"sedan",
         "midsize sedan, driver aboard",
         "sedan",
         "macpherson",
         "five_link",
         DrivenWheels::rear,
         {4.35, 2.50, 1.66, 1.23, 1.00, 0.85},
         {1550, 0.51,        0.54, 2.76,       1.51, 1.52, 4.60, 1.81, 1.43, 0.320, 1.2, 1.4, 4.5 * degree_per_g,
          16,   37 * degree, 250,  6800 * rpm, 3.23, 0.29, 1}},
        {"roadster",
         "light two-seater, driver aboard",
         "sedan",
         "double_wishbone",
         "double_wishbone",
         DrivenWheels::rear,
         {3.14, 1.89, 1.33, 1.00, 0.81},
         {1040, 0.52,        0.46, 2.27,       1.41, 1.42, 3.95, 1.68, 1.23, 0.289, 1.4, 1.5, 4.5 * degree_per_g,
          16,   37 * degree, 140,  7200 * rpm, 4.30, 0.38, 1}},
        {"off_roader",
         "off-road vehicle on solid axles, driver aboard",
         "off_roader",
         "panhard_axle",
         "four_link_axle",
         DrivenWheels::all,
         {4.10, 2.30, 1.50, 1.18, 1.00, 0.83},
         {2050, 0.50,        0.75, 2.60,       1.50, 1.50, 4.65, 1.80, 1.85, 0.375, 1.3, 1.5, 6.5 * degree_per_g,
          18,   34 * degree, 320,  5400 * rpm, 3.90, 0.42, 0.85}},
        {"pickup",
         "full-size pickup, driver aboard",
         "pickup",
         "double_wishbone",
         "leaf_axle",
         DrivenWheels::rear,
         {4.03, 2.36, 1.53, 1.15, 0.85, 0.67},
         {2350, 0.57,        0.70, 3.66,       1.72, 1.70, 5.85, 2.03, 1.90, 0.392, 1.2, 1.5, 5.5 * degree_per_g,
          17,   36 * degree, 450,  6000 * rpm, 3.42, 0.42, 0.9}},
    };
    return classes;
}

std::span<const ClassSetting> class_settings() {
    using V = ClassValues;
    static constexpr ClassSetting settings[]{
        {"mass_kg", "with the driver", &V::mass, 1, 200, 6000},
        {"front_load_percent", "of the weight on the front axle", &V::front_load, percent, 30, 70},
        {"center_of_mass_height_m", "over the road", &V::center_height, 1, 0.2, 1.5},
        {"wheelbase_m", "", &V::wheelbase, 1, 1.4, 6},
        {"front_track_m", "", &V::front_track, 1, 1, 2.4},
        {"rear_track_m", "", &V::rear_track, 1, 1, 2.4},
        {"length_m", "overall", &V::length, 1, 2, 8},
        {"width_m", "overall, without mirrors", &V::width, 1, 1.2, 2.6},
        {"height_m", "overall", &V::height, 1, 0.8, 3},
        {"tire_radius_m", "unloaded", &V::tire_radius, 1, 0.2, 0.6},
        {"front_ride_Hz", "of the body on its front springs", &V::front_ride, 1, 0.8, 4},
        {"rear_ride_Hz", "of the body on its rear springs", &V::rear_ride, 1, 0.8, 4},
        {"roll_deg_per_g", "of lateral acceleration; anti-roll bars add to the springs", &V::roll_gradient,
         degree_per_g, 0.5, 15},
        {"steering_ratio", "steering wheel over road wheels", &V::steering_ratio, 1, 5, 30},
        {"lock_deg", "of the inner wheel at full lock", &V::lock_angle, degree, 15, 45},
        {"engine_torque_N_m", "the largest", &V::max_torque, 1, 20, 2000},
        {"engine_limit_rpm", "where the engine is limited", &V::max_speed, rpm, 2000, 12000},
        {"final_drive", "ratio", &V::final_drive, 1, 1, 8},
        {"drag_coefficient", "", &V::drag_coefficient, 1, 0.1, 1.5},
        {"tire_friction", "over a passenger car tire's, 1.03 to the side", &V::tire_friction, 1, 0.1, 2},
    };
    return settings;
}

}  // namespace hamilcar
