// A scenario as a person writes it down: which vehicle, from where, for how long, what the driver does, what is recorded.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hamilcar/description/driver.hpp"
#include "hamilcar/description/maneuver.hpp"
#include "hamilcar/description/places.hpp"
#include "hamilcar/description/road.hpp"
#include "hamilcar/description/signal.hpp"

namespace hamilcar {

enum class SteeringInput { none, steering_wheel, rack };
enum class ConstraintMode { exact, stabilized };  // W solved from Phi = 0, or integrated with (27)
enum class StabilizationRule {
    paper,
    limit,
    value
};  // alpha = ST_k / h of Table 3, a fraction of the exact limit, or a number
enum class ChassisChart { quaternion, bryant };  // orientation coordinates of the chassis

struct SolverDescription {
    double step = 1e-3;              // [s]
    std::string integrator = "ab3";  // name in the list of integrators
    double tolerance = 1e-8;         // relative error per step, adaptive methods only [1]
    ConstraintMode constraints = ConstraintMode::exact;
    StabilizationRule stabilization = StabilizationRule::paper;
    double stabilization_gain = 0;  // alpha [1/s], with StabilizationRule::value
    ChassisChart chart = ChassisChart::quaternion;
    bool energy_balance = true;  // integrate the work along, so that the run can check itself; costs a tenth to a fifth
    bool check_stability = true;  // refuse a gain beyond the limit; only the sweep of Fig. 9 turns it off
};

// The chassis is first put in static equilibrium on the road (unless `settle` is false: then at `height`), then moved.
struct InitialDescription {
    bool settle = true;
    std::array<double, 2> position{};          // x, y of the vehicle origin on the ground [m]
    double height = 0;                         // of the vehicle origin above the road, if not settled [m]
    double yaw = 0;                            // [rad]
    double roll = 0, pitch = 0;                // if not settled [rad]
    std::array<double, 3> velocity{};          // of the vehicle origin, vehicle axes [m/s]; wheels roll along
    std::array<double, 3> angular_velocity{};  // vehicle axes [rad/s]
};

struct OutputDescription {
    double interval = 0.01;             // [s]
    std::vector<std::string> channels;  // names or prefixes with '*'; empty: the default set
    bool csv = true, netcdf = true;
    bool motion = true;  // netCDF: also what a picture of the vehicle is drawn from
    bool report = true;  // a page with the replay and the plots of the run
};

struct ScenarioDescription {
    std::string name;
    std::string vehicle;  // path of the vehicle file, resolved against the scenario's folder
    double duration = 0;  // [s]
    SolverDescription solver;
    InitialDescription initial;
    RoadDescription road;
    SteeringInput steering_input = SteeringInput::none;
    SignalDescription steering;         // steering wheel angle [rad] or rack displacement [m]
    SignalDescription hands;            // how firmly they hold the steering wheel, 0 off to 1 [1]
    SignalDescription steering_torque;  // of the hands besides [N m]
    bool steering_mechanics = false;    // the rack moves on its own, as the vehicle's steering makes it
    SignalDescription drive;            // torque at the driven wheels together [N m]
    SignalDescription brake;            // pedal command, 0 to 1 [1]
    SignalDescription parking_brake;    // lever, 0 released to 1 [1]
    SignalDescription throttle;         // pedal of the power units, 0 to 1 [1]
    SignalDescription clutch;           // pedal, 0 released to 1 pressed [1]
    SignalDescription gear;             // -1 reverse, 0 neutral, 1 first, ... [1]
    SignalDescription wind_x, wind_y;   // velocity of the air, ground axes [m/s]
    DriverDescription driver;           // acts where inputs are not given
    // Kinds of the vehicle's controllers that are not there; "all": every one.
    std::vector<std::string> controllers_off;
    ManeuverDescription maneuver;  // drives instead of inputs and driver
    OutputDescription output;
    std::vector<std::array<double, 2>> cones;  // that mark a course; nothing feels them: x, y on the ground [m]
    std::shared_ptr<const Places> places;      // of its keys; none where no file was read
};

// Whether the rack moves on its own: where somebody asks for the mechanics of the steering, or uses its torque or takes the hands off.
// In all other runs the rack is prescribed.
inline bool has_free_rack(const ScenarioDescription& scenario) {
    return scenario.steering_mechanics || !scenario.hands.time.empty() || !scenario.steering_torque.time.empty();
}

// Whether the vehicle's power units run: where somebody uses pedal and gears. In all other runs a torque at the wheels stands
// for them, and rotors are a part of the chassis.
inline bool is_powered(const ScenarioDescription& scenario) {
    return !scenario.throttle.time.empty() || !scenario.gear.time.empty() || scenario.driver.shifting.has_value();
}

}  // namespace hamilcar
