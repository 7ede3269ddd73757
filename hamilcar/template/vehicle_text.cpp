// The file of a new vehicle, but for its axles.
#include <fmt/format.h>

#include <array>

#include "hamilcar/base/units.hpp"
#include "hamilcar/template/vehicle_sizes.hpp"

namespace hamilcar {

namespace {

std::string chassis_text(const VehicleSizes& sizes) {
    const ClassValues& v = sizes.values();
    const double kx = 0.4 * v.front_track, ky = 0.47 * v.wheelbase, kz = 0.49 * v.wheelbase;  // of the whole vehicle
    const double x = -v.wheelbase * (1 - v.front_load);
    double mass = v.mass, sum_x = v.mass * x, sum_z = v.mass * v.center_height;
    Point inertia{v.mass * kx * kx, v.mass * ky * ky, v.mass * kz * kz};
    for (const AxleSizes* axle : {&sizes.front, &sizes.rear}) {
        for (const AxleBody& body : bodies_of(*axle)) {
            const double m = body.copies() * body.mass;
            const double dx = body.center[0] - x, y = body.center[1], dz = body.center[2] - v.center_height;
            const auto& [rx, ry, rz] = body.radii;
            mass -= m, sum_x -= m * body.center[0], sum_z -= m * body.center[2];
            inertia[0] -= m * (y * y + dz * dz + rx * rx);
            inertia[1] -= m * (dx * dx + dz * dz + ry * ry);
            inertia[2] -= m * (dx * dx + y * y + rz * rz);
        }
    }
    // To the chassis' own center of mass.
    const double cx = sum_x / mass - x, cz = sum_z / mass - v.center_height;
    inertia[0] -= mass * cz * cz, inertia[1] -= mass * (cx * cx + cz * cz), inertia[2] -= mass * cx * cx;
    return "[chassis]\n" +
           line("mass_kg", fmt::format("{:.1f}", mass),
                fmt::format("[E] {} kg in all, less what moves with the wheels", number(v.mass))) +
           line("center_of_mass_m", point({sum_x / mass, 0, sum_z / mass}),
                fmt::format("[E] whole vehicle: {:.0f} percent in front, {} m high", 100 * v.front_load,
                            number(v.center_height))) +
           line("inertia_kg_m2",
                fmt::format("[{}, {}, {}]", number(inertia[0]), number(inertia[1]), number(inertia[2])),
                fmt::format("[E] radii of the whole: {:.2f}, {:.2f}, {:.2f} m, less the wheels'", kx, ky, kz));
}

std::string outside_text(const VehicleSizes& sizes) {
    const ClassValues& v = sizes.values();
    const double front = 0.5 * (v.length - v.wheelbase);
    return "\n[steering]\n" +
           line("rack_m_per_revolution", number(sizes.rack_per_revolution),
                fmt::format("[E] {}:1 at the wheels", number(v.steering_ratio))) +
           line("rack_travel_m", number(sizes.rack_travel),
                fmt::format("[E] {:.0f} degrees inside at full lock", v.lock_angle / units::degree)) +
           "\n[aerodynamics]\n" + line("drag_coefficient", number(v.drag_coefficient), "[E]") +
           line("frontal_area_m2", number(0.81 * v.width * v.height), "[E] 0.81 x width x height") +
           "\n# What it looks like; nothing is calculated from it.\n[body]\n" +
           line("style", fmt::format("\"{}\"", sizes.request->like->body_style)) +
           line("front_m", number(front), "[E] half of what is longer than the wheelbase") +
           line("length_m", number(v.length), "[E]") + line("width_m", number(v.width), "[E]") +
           line("bottom_m", number(0.5 * v.tire_radius), "[E]") + line("top_m", number(v.height), "[E]");
}

// The handbook's passenger car tire, its forces in proportion to the load that it carries here.
std::string tire_text(const VehicleSizes& sizes) {
    const double load = sizes.tire_load, radius = sizes.values().tire_radius;
    const auto curve = [&](const char* direction, const char* at, std::array<double, 5> c, const std::string& why) {
        return fmt::format("\n[tire.road.{}.{}]\n", direction, at) + line("stiffness_N", number(c[0] * load), why) +
               line("peak_slip", number(c[1]), "[E]") + line("peak_force_N", number(c[2] * load), "[E]") +
               line("sliding_slip", number(c[3]), "[E]") + line("sliding_force_N", number(c[4] * load), "[E]");
    };
    return "\n# A measured tire is named by its file: model = \"magic_formula\" and file = \"my_tire.tir\", beside "
           "this file, or a\n"
           "# shipped one by its name; docs/files/tire.md.\n[tire.road]\n" +
           line("model", "\"tmeasy\"") + line("radius_m", number(radius), "[E] unloaded") +
           line("rolling_radius_m", number(radius * (1 - deflection_share / 3)), "[E] less a third of the deflection") +
           line("vertical_stiffness_N_per_m", number(sizes.tire_stiffness),
                "[E] 6 percent of the radius under its load") +
           line("vertical_damping_N_s_per_m", number(0.0015 * sizes.tire_stiffness), "[E]") +
           line("rolling_resistance", "0.012", "[E]") +
           line("friction_scale", number(sizes.values().tire_friction), "[E] on dry asphalt") +
           line("nominal_load_N", number(load), "[E] a quarter of the weight") +
           line("carcass_longitudinal_N_per_m", number(1.6 * sizes.tire_stiffness), "[E]") +
           line("carcass_lateral_N_per_m", number(0.7 * sizes.tire_stiffness), "[E]") +
           curve("longitudinal", "at_nominal_load", {30, 0.11, 1.1, 0.5, 1.05}, "[E] a passenger car's over its load") +
           curve("longitudinal", "at_twice_the_load", {50, 0.10, 2.15, 0.8, 2.0}, "[E]") +
           curve("lateral", "at_nominal_load", {17, 0.18, 1.03, 0.8, 1.0}, "[E] a passenger car's over its load") +
           curve("lateral", "at_twice_the_load", {27, 0.20, 1.88, 1.0, 1.8}, "[E]") + "\n[tire.road.trail]\n" +
           line("over_contact_length", "[0.18, 0.19]", "[E] at the nominal load, at twice it") +
           line("vanishes_at_slip", "[0.20, 0.22]", "[E]") + line("ends_at_slip", "[0.35, 0.40]", "[E]");
}

std::string differential_text(const char* name, const std::string& outputs, const ClassValues& v, bool is_final) {
    std::string out = "\n[[differential]]\n" + line("name", fmt::format("\"{}\"", name));
    if (is_final) out += line("ratio", number(v.final_drive), "[E]");
    return out + line("outputs", outputs);
}

std::string drive_text(const VehicleSizes& sizes) {
    const ClassValues& v = sizes.values();
    const DrivenWheels drive = sizes.request->drive;
    std::string out;
    if (drive != DrivenWheels::rear) out += differential_text("front", "[\"front_left\", \"front_right\"]", v, true);
    if (drive != DrivenWheels::front) out += differential_text("rear", "[\"rear_left\", \"rear_right\"]", v, true);
    if (drive == DrivenWheels::all) out += differential_text("center", "[\"front\", \"rear\"]", v, false);
    std::string speeds, torques, gears;
    constexpr std::array<std::array<double, 2>, 9> shape{
        {{0.1, 0.6}, {0.25, 0.8}, {0.4, 0.92}, {0.55, 1}, {0.7, 0.98}, {0.8, 0.94}, {0.9, 0.86}, {0.97, 0.76}, {1, 0}}};
    const double limit = v.max_speed / units::rpm;
    for (const auto& [speed, torque] : shape) {
        speeds += fmt::format("{}{:.0f}", speeds.empty() ? "" : ", ", speed * limit);
        torques += fmt::format("{}{:.0f}", torques.empty() ? "" : ", ", torque * v.max_torque);
    }
    for (const double gear : sizes.request->like->gears) gears += (gears.empty() ? "" : ", ") + number(gear);
    const char* output = drive == DrivenWheels::all ? "center" : drive == DrivenWheels::front ? "front" : "rear";
    const auto rpm = [&](double share) { return fmt::format("{:.0f}", share * limit); };
    return out + "\n[[power_unit]]\n" + line("name", "\"engine\"") + line("output", fmt::format("\"{}\"", output)) +
           (drive == DrivenWheels::front ? line("axis", "[0.0, 1.0, 0.0]", "layout: across the vehicle") : "") +
           line("response_time_s", "0.1", "[E]") + "\n[power_unit.engine]\n" + line("idle_rpm", rpm(0.12), "[E]") +
           line("speed_rpm", "[" + speeds + "]") + line("full_load_N_m", "[" + torques + "]", "[E]") +
           "\n[power_unit.clutch]\n" + line("capacity_N_m", number(1.7 * v.max_torque), "[E]") +
           "\n[power_unit.gearbox]\n" + line("ratios", "[" + gears + "]", "[E]") +
           line("reverse_ratio", number(0.9 * sizes.request->like->gears[0]), "[E]") +
           line("efficiency", "0.92", "[E]") + line("upshift_rpm", rpm(0.92), "[E] pedal pressed") +
           line("upshift_closed_rpm", rpm(0.38), "[E] released") + line("downshift_rpm", rpm(0.27), "[E]") +
           line("downshift_closed_rpm", rpm(0.18), "[E]");
}

}  // namespace

std::string vehicle_text(const VehicleSizes& sizes) {
    const auto title = [](const std::string& word) { return fmt::format("\n# {:->118}\n", " " + word); };
    const VehicleClass& like = *sizes.request->like;
    return fmt::format("# {}: made by `hamilcar new --like {}`, {}.\n", sizes.request->name, like.name, like.title) +
           "# Every number is an estimate, [E]. Put in what you know, with its grade: [P] published or measured, [D] "
           "derived.\n"
           "# The keys are in docs/files/vehicle.md.\n"
           "#\n"
           "# Vehicle frame: ISO 8855 (x forward, y left, z up); origin on the ground, in the middle plane, under the "
           "front\n"
           "# wheel centers at the design position. Left side given; the right side is its mirror image.\n\n" +
           line("name", fmt::format("\"{}\"", sizes.request->name)) + "\n" + chassis_text(sizes) + outside_text(sizes) +
           tire_text(sizes) + title("front") + axle_text(sizes.front) + title("rear") + axle_text(sizes.rear) +
           title("drive") + drive_text(sizes).substr(1);
}

}  // namespace hamilcar
