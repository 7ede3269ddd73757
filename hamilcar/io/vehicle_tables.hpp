// The readers of the tables of a vehicle file, from bodies to axles: vehicle_file.cpp puts them together.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "hamilcar/description/vehicle.hpp"
#include "hamilcar/io/table_reader.hpp"
#include "hamilcar/suspension/recipe.hpp"

namespace hamilcar::io {

// A rigid body: `mass_kg`, `center_of_mass_m`, `inertia_kg_m2`, `products_kg_m2`. A carrier's inertia leaves out what spins;
// `wheel` says what that is.
BodyDescription read_body(const TableReader& table, const WheelDescription& wheel = {});

// Whether the body, its inertia that of all it holds, has room for rotors with these inertias about their axes, unit vectors.
bool has_room_for(const BodyDescription& body, const std::vector<std::pair<double, Point>>& rotors);

// What hangs on a suspension.
WheelDescription read_wheel(const TableReader& wheel);
DamperDescription read_damper(const TableReader& damper);
StopDescription read_stop(const std::optional<TableReader>& stop);
// `system`: that it belongs to, whose medium decides what else there is to say of it.
BrakeDescription read_brake(const std::optional<TableReader>& brake, const WheelDescription& wheel,
                            const BrakeSystemDescription& system);
// What a brake has in a brake system only: its line, its kind and its heat. Its torque is known.
void read_brake_in_system(const TableReader& brake, const BrakeSystemDescription& system, BrakeDescription& to);

// All tables [tire.NAME] of a file, as they are on the left side of the vehicle, and the one that an axle names. A new model
// is one function that reads its keys and one line in a list.
using NamedTires = std::vector<std::pair<std::string, TireDescription>>;
NamedTires read_tires(const TableReader& file);
const TireDescription& tire_of(const TableReader& axle, const NamedTires& tires);

// A linkage that a file composes itself, suspension = "linkage": [[axle.joint]], [[axle.cut]], `carrier_part` and, for an axle
// with two wheels, `right_carrier_part`. Checked: every part is carried, and the wheels have one freedom each.
Composition read_linkage(const TableReader& axle, const WheelDescription& wheel, bool two_wheels, bool on_trailer);
// The right side of a linkage with one wheel.
Composition mirrored_composition(Composition left);

// An axle as it stands in the file, and with the keys of [axle.right], as a left side, laid over it.
struct AxleTables {
    const TableReader& left;
    std::optional<TableReader> right{};  // none: the right side is the mirror image of the left one

    bool differ() const { return right.has_value(); }
    const TableReader& of_right() const { return right ? *right : left; }
};

// An axle's two sides. Where one suspension carries both wheels, the left composition is that of both.
struct AxleSides {
    Composition left, right;
    std::string_view default_part;              // that springs act on unless the file says otherwise
    double bar_force = 0, bar_response = 0.03;  // of its actuator, if it has one [N], [s]
    std::optional<double> bar_rate{};  // of an anti-roll bar [N/m], or [N m/rad] where the compositions have its arms

    bool hold_both() const { return left.carriers.size() == 2; }
    const Composition& of_right() const { return hold_both() ? left : right; }
};
using UseSides = std::function<void(const AxleSides&)>;

// The part that a key names, and all names.
const PartChoice& part_of(const TableReader& table, std::string_view key, const Composition& composition,
                          std::string_view fallback);
std::vector<std::string_view> part_names(const Composition& composition);

// Calls `use` with the compositions of a recipe, or of a file's own linkage, with everything that is attached to them: once, or as often
// as the keys may differ where there is no file.
void read_recipe(const AxleTables& axle, const Recipe& recipe, bool on_trailer, const UseSides& use);
void read_own_linkage(const AxleTables& axle, bool on_trailer, const UseSides& use);

// [axle.spring], [[axle.further_spring]], and likewise dampers. Each is given as on the left side; the right side has its mirror image.
// The two suspensions may be one.
void add_springs_and_dampers(const AxleTables& axle, const AxleSides& sides, SuspensionDescription& left,
                             SuspensionDescription& right);

// [axle.alignment]: sets the angles of the wheels.
void align_axle(const AxleTables& axle, const AxleSides& sides, SuspensionDescription& left,
                SuspensionDescription& right);

// Adds an axle's suspensions, one with two wheels or one on each side, to the vehicle; `unit` is what they hang on.
void read_axle(const TableReader& axle, const NamedTires& tires, std::size_t unit, VehicleDescription& vehicle);

// Reads [[differential]] into the vehicle, whose axles are there already, and returns their tables in the vehicle's order.
std::vector<TableReader> read_differentials(const TableReader& file, VehicleDescription& vehicle);

// [steering]: the rack and what moves it.
SteeringDescription read_steering(const std::optional<TableReader>& table);

// [brakes], from the pedal to the lines.
BrakeSystemDescription read_brake_system(const TableReader& file);

// Reads [[controller]] and [sensors]; both may be left out, and `controllers = false` leaves out the controllers of a base. Everything
// else of the vehicle is there already.
void read_controllers(const TableReader& file, VehicleDescription& vehicle);
SensorsDescription read_sensors(const std::optional<TableReader>& table);

// What a power unit consists of.
EngineDescription read_engine(const TableReader& table);
MotorDescription read_motor(const TableReader& table);
std::variant<ClutchDescription, ConverterDescription> read_coupling(const TableReader& unit);
GearboxDescription read_gearbox(const std::optional<TableReader>& table);
ShaftsDescription read_shafts(const std::optional<TableReader>& table);
// 2 to max_curve_points.
void expect_points(const TableReader& table, std::string_view key, std::size_t count);
// `vehicle`: with its power units.
BatteryDescription read_battery(const std::optional<TableReader>& table, const VehicleDescription& vehicle);

// Reads [[differential]], [[power_unit]] and [battery]; they may be left out, and `powertrain = false` leaves out those of a base.
void read_powertrain(const TableReader& file, VehicleDescription& vehicle);

}  // namespace hamilcar::io
