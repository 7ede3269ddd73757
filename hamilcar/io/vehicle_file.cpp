// The whole vehicle from its tables: hub first, then axle by axle, each left and right.
#include "hamilcar/io/vehicle_file.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "hamilcar/io/axle_file.hpp"
#include "hamilcar/io/body_file.hpp"
#include "hamilcar/io/mirror.hpp"
#include "hamilcar/io/number_text.hpp"

namespace hamilcar::io {

namespace {

double read_drag_area(const TableReader& aerodynamics) {
    if (aerodynamics.chosen({{"drag_area_m2"}, {"drag_coefficient", "frontal_area_m2"}}) == 0) {
        return aerodynamics.number("drag_area_m2", not_negative);
    }
    return aerodynamics.number("drag_coefficient", not_negative) * aerodynamics.number("frontal_area_m2", not_negative);
}

AerodynamicsDescription read_aerodynamics(const std::optional<TableReader>& table, const BodyDescription& chassis) {
    if (!table) return {.drag_area = 0, .air_density = 0, .center = chassis.center_of_mass};
    return {read_drag_area(*table), table->number("air_density_kg_per_m3", not_negative),
            table->array<3>("center_m", chassis.center_of_mass)};
}

// Points of the left side; each has its mirror image.
HullDescription read_hull(const std::optional<TableReader>& table) {
    if (!table) return {};
    HullDescription hull{.points = {},
                         .stiffness = table->number("stiffness_N_per_m", positive),
                         .damping = table->number("damping_s_per_m", not_negative),
                         .friction = table->number("friction", not_negative)};
    for (const TableReader& point : table->tables("point")) {
        const Point left = point.array<3>("at_m");
        hull.points.push_back(left);
        hull.points.push_back({left[0], -left[1], left[2]});
    }
    return hull;
}

SteeringDescription read_steering(const std::optional<TableReader>& table) {
    if (!table) return {};
    return {table->number("rack_m_per_revolution", positive), table->number("rack_travel_m", positive)};
}

// Axle names become parts of channel and file names.
void check_name(const TableReader& axle, const std::vector<CornerDescription>& before) {
    const std::string name = axle.text("name");
    const auto allowed = [](unsigned char c) { return std::isalnum(c) || c == '_'; };
    axle.expect(std::ranges::all_of(name, allowed), "name", "letters, digits and '_' only");
    const auto taken = [&](const CornerDescription& corner) { return corner.name == name + "_left"; };
    axle.expect(std::ranges::none_of(before, taken), "name", "a name that no other axle has");
}

void read_axle(const TableReader& axle, const NamedTires& tires, VehicleDescription& vehicle) {
    check_name(axle, vehicle.corners);
    const std::size_t left = vehicle.corners.size();
    vehicle.corners.push_back(read_left_corner(axle, tires));
    vehicle.corners.push_back(mirrored(vehicle.corners.back()));
    vehicle.corners.back().name = axle.text("name") + "_right";
    if (const auto bar = axle.optional_table("anti_roll_bar")) {
        vehicle.anti_roll_bars.push_back({left, left + 1, bar->number("rate_N_per_m", not_negative)});
    }
}

}  // namespace

VehicleDescription read_vehicle(const std::string& path) {
    Node document = read_toml(path);
    const TableReader file(document, "");
    const BodyDescription chassis = read_body(file.table("chassis"));
    VehicleDescription vehicle{.name = file.text("name"),
                               .chassis = chassis,
                               .corners = {},
                               .anti_roll_bars = {},
                               .aerodynamics = read_aerodynamics(file.optional_table("aerodynamics"), chassis),
                               .hull = read_hull(file.optional_table("hull")),
                               .steering = read_steering(file.optional_table("steering")),
                               .gravity = file.number("gravity_m_per_s2", not_negative, 9.80665)};
    const NamedTires tires = read_tires(file);
    const std::vector<TableReader> axles = file.tables("axle");
    file.expect(axles.size() <= max_spokes / 2, "axle", "at most " + std::to_string(max_spokes / 2) + " axles");
    for (const TableReader& axle : axles) read_axle(axle, tires, vehicle);

    double driven = 0;
    for (const CornerDescription& corner : vehicle.corners) driven += corner.drive_share;
    axles.back().expect(driven == 0 || std::abs(driven - 1) < 1e-9, "drive_share",
                        "shares of all axles that add up to 1, or to 0 (here " + number_text(driven) + ")");
    file.finish();
    return vehicle;
}

}  // namespace hamilcar::io
