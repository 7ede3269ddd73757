// The whole vehicle from its tables: chassis first, then axle by axle, each left and right.
#include "hamilcar/io/vehicle_file.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "hamilcar/base/text.hpp"
#include "hamilcar/block/preload.hpp"
#include "hamilcar/io/bodywork_file.hpp"
#include "hamilcar/io/choices.hpp"
#include "hamilcar/io/default_values.hpp"
#include "hamilcar/io/every_mistake.hpp"
#include "hamilcar/io/file_kind.hpp"
#include "hamilcar/io/vehicle_tables.hpp"
#include "hamilcar/vehicle/vehicle.hpp"

namespace hamilcar::io {

namespace {

void read_air_areas(const TableReader& table, AerodynamicsDescription& air) {
    air.drag_area = table.number("drag_area_m2", not_negative);
    air.lift_area = {table.number("lift_area_front_m2", any_number, 0),
                     table.number("lift_area_rear_m2", any_number, 0)};
    if (table.has("side_force_area_m2")) air.side_area = table.number("side_force_area_m2", not_negative);
    air.yaw_volume = table.number("yaw_moment_volume_m3", any_number, 0);
}

void read_air_coefficients(const TableReader& table, AerodynamicsDescription& air) {
    const double area = table.number("frontal_area_m2", not_negative);
    air.drag_area = table.number("drag_coefficient", not_negative) * area;
    air.lift_area = {table.number("lift_coefficient_front", any_number, 0) * area,
                     table.number("lift_coefficient_rear", any_number, 0) * area};
    if (table.has("side_force_coefficient")) {
        air.side_area = table.number("side_force_coefficient", not_negative) * area;
    }
    table.choose_presence("yaw_moment_coefficient", [&](bool present) {
        if (!present) return;
        const double length = table.number("reference_length_m", positive);
        air.yaw_volume = table.number("yaw_moment_coefficient", any_number) * area * length;
    });
}

// Along x, of the foremost and the rearmost wheels of the motor vehicle.
std::array<double, 2> end_axles(const VehicleDescription& vehicle) {
    std::vector<double> places;
    for_each_wheel(vehicle, [&](const auto& wheel, std::size_t unit) {
        if (unit == 0) places.push_back(wheel.wheel.center[0]);
    });
    return {*std::ranges::max_element(places), *std::ranges::min_element(places)};
}

AerodynamicsDescription read_aerodynamics(const std::optional<TableReader>& table, const VehicleDescription& vehicle) {
    AerodynamicsDescription air;
    air.center = vehicle.chassis.center_of_mass;
    if (!table) return air;
    table->choose(
        {{"drag_area_m2", "lift_area_front_m2", "lift_area_rear_m2", "side_force_area_m2", "yaw_moment_volume_m3"},
         {"drag_coefficient", "frontal_area_m2", "lift_coefficient_front", "lift_coefficient_rear",
          "side_force_coefficient", "yaw_moment_coefficient", "reference_length_m"}},
        [&](std::size_t group) { (group == 1 ? read_air_coefficients : read_air_areas)(*table, air); });
    air.air_density = table->number("air_density_kg_per_m3", not_negative, default_air_density);
    air.center = table->array<3>("center_m", air.center);
    air.lift_place = table->array<2>("lift_places_m", end_axles(vehicle));
    return air;
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

void read_axles(const TableReader& owner, const NamedTires& tires, std::size_t unit, std::vector<std::string>& names,
                VehicleDescription& vehicle) {
    for (const TableReader& axle : owner.tables("axle")) {
        check_name(axle, names, "axle or trailer");
        read_axle(axle, tires, unit, vehicle);
    }
    owner.expect(vehicle.suspensions.size() <= max_suspensions, "axle",
                 std::to_string(max_suspensions) + " suspensions at most");
}

void read_trailer(const TableReader& table, const NamedTires& tires, std::vector<std::string>& names,
                  VehicleDescription& vehicle) {
    check_name(table, names, "axle or trailer");
    constexpr std::string_view hitches[] = {"ball", "fifth_wheel"};
    TrailerDescription trailer;
    trailer.name = table.text("name");
    trailer.hitch = static_cast<Hitch>(table.one_of("hitch", hitches));
    if (table.has("tow")) {
        std::vector<std::string_view> before;
        for (const TrailerDescription& other : vehicle.trailers) before.push_back(other.name);
        table.expect(!before.empty(), "tow", "the name of a trailer that stands before this one in the file");
        trailer.tow = table.one_of("tow", before) + 1;
    }
    trailer.hitch_point = table.array<3>("hitch_m");
    trailer.yaw_damping = table.number("yaw_damping_N_m_s_per_rad", not_negative, 0);
    trailer.chassis = read_body(table.table("chassis"));
    trailer.bodywork = read_bodywork(table.optional_table("body"));
    vehicle.trailers.push_back(trailer);
    read_axles(table, tires, vehicle.trailers.size(), names, vehicle);
}

}  // namespace

VehicleDescription read_vehicle(const std::string& path) {
    VehicleDescription vehicle;
    expect_kind(path, FileKind::vehicle, [&] {
        Node document = read_toml(path);
        vehicle = read_vehicle(document);
    });
    return vehicle;
}

VehicleDescription read_vehicle(Node& document) {
    VehicleDescription vehicle;
    with_every_mistake(
        document, [](const TableReader& file) { read_vehicle(file); },
        [&] { vehicle = read_vehicle(TableReader(document, "")); });
    vehicle.places = places_of(document);
    return vehicle;
}

VehicleDescription read_vehicle(const TableReader& file) {
    const BodyDescription chassis = read_body(file.table("chassis"));
    VehicleDescription vehicle{.name = file.text("name"),
                               .chassis = chassis,
                               .suspensions = {},
                               .anti_roll_bars = {},
                               .trailers = {},
                               .aerodynamics = {},
                               .hull = read_hull(file.optional_table("hull")),
                               .steering = read_steering(file.optional_table("steering")),
                               .power_units = {},
                               .differentials = {},
                               .gravity = file.number("gravity_m_per_s2", not_negative, 9.80665),
                               .bodywork = read_bodywork(file.optional_table("body")),
                               .places = {}};
    vehicle.brakes = read_brake_system(file);
    const NamedTires tires = read_tires(file);
    std::vector<std::string> names;
    read_axles(file, tires, 0, names, vehicle);
    if (file.has("trailer")) {
        for (const TableReader& trailer : file.tables("trailer")) read_trailer(trailer, tires, names, vehicle);
        file.expect(vehicle.trailers.size() <= max_trailers, "trailer",
                    std::to_string(max_trailers) + " trailers at most");
    }
    file.expect(
        StateLayout(vehicle).size() <= state_capacity, "axle",
        std::to_string(beyond_chassis_capacity) + " coordinates, momenta and wheel states of suspensions at most");
    const double driven = driven_share(vehicle);
    file.tables("axle").back().expect(
        driven == 0 || std::abs(driven - 1) < 1e-9, "drive_share",
        "shares of all axles that add up to 1, or to 0 (here " + number_text(driven) + ")");
    vehicle.aerodynamics = read_aerodynamics(file.optional_table("aerodynamics"), vehicle);
    read_powertrain(file, vehicle);
    file.expect(StateLayout(vehicle).size() <= state_capacity, "power_unit",
                "fewer coordinates of suspensions, or fewer power units and differentials: together they hold " +
                    std::to_string(beyond_chassis_capacity) + " numbers at most");
    read_controllers(file, vehicle);
    vehicle.sensors = read_sensors(file.optional_table("sensors"));
    file.finish();
    if (!file.is_recording()) {
        const auto obstacle = find_preloads(vehicle);
        file.expect(!obstacle, "axle", obstacle.value_or(""));
    }
    return vehicle;
}

}  // namespace hamilcar::io
