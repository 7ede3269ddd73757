// A closed-loop driver: in every interval it observes the car, decides, and moves its controls at constant rates to their targets
// at the interval's end. All other controls follow the scenario.
//
//     Observation ─► path follower ─► rack
//                    speed control ─► throttle, brake (or torque at the wheels) ─┐
//                    shifting ─► gear, clutch, and the throttle's share ◄────────┘
//                    ending ─► whether the run is over
#pragma once

#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "hamilcar/driver/ending.hpp"
#include "hamilcar/driver/path_follower.hpp"
#include "hamilcar/driver/shifting.hpp"
#include "hamilcar/driver/speed_control.hpp"

namespace hamilcar {

class Schedule;

// Everything that later decisions depend on, apart from the positions of the controls. Together with the schedule's memory it
// lets a run be resumed bit for bit.
struct DriverMemory {
    bool begun = false;
    double first_time = 0;  // of the first decision [s]
    bool has_throttle = false;
    double throttle = 0;  // that was asked for in place of the scenario's, if any [1]
    PathMemory path;
    SpeedMemory speed;
    ShiftMemory shifting;
    EndingMemory ending;
};
static_assert(std::is_trivially_copyable_v<DriverMemory>);

class Driver {
public:
    Driver() = default;  // does nothing
    // act() must be called once per interval of the description, since controls move from one decision to the next.
    // Throws std::invalid_argument for what cannot be driven: a path through one point, a gear that does not exist.
    Driver(const DriverDescription& description, const DrivenCar& car, const Column& column);

    bool is_active() const { return follower_ || speed_ || shifting_ || ending_; }
    double interval() const { return interval_; }  // [s]
    // Stores the scenario's throttle, for a driver that only shifts. Call once, before the first decision.
    void begin(const Schedule& schedule);
    // Another throttle than the scenario's from the next decision on, for a driver that only shifts.
    void ask_throttle(double throttle) { memory_.has_throttle = true, memory_.throttle = throttle; }
    // Decides for the next interval, without allocation. Called again at the first instant it starts over, so that a gear can
    // be chosen once a gear is engaged and the shaft speeds are known.
    void act(const Observation& observation, Schedule& schedule);

    // Why the run ended, with the value reached.
    std::optional<std::string> end_reason() const;
    // Targets that were missed, with the values reached.
    std::vector<std::string> warnings() const;
    // Position of the center of mass relative to the path; zero without a path.
    PathPlace place() const { return {memory_.path.station, memory_.path.offset}; }

    const DriverMemory& memory() const { return memory_; }
    void restore(const DriverMemory& memory) { memory_ = memory; }

private:
    void update_pedals(const Observation& observation, Schedule& schedule, bool first);
    void update_gears(const Observation& observation, double throttle, Schedule& schedule, bool first);

    double interval_ = 0.005;
    DrivenCar car_;
    std::optional<PathFollower> follower_;
    std::optional<SpeedControl> speed_;
    std::optional<Shifting> shifting_;
    std::optional<Ending> ending_;
    bool brakes_ = false;        // the driver operates the brake
    Signal scheduled_throttle_;  // from the scenario
    DriverMemory memory_;
};

}  // namespace hamilcar
