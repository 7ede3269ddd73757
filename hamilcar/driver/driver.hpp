// A driver who looks: at every interval he sees the car, decides, and leads the controls that he works evenly to where he
// wants them at the interval's end. What he does not work goes on as the scenario says.
//
//     Senses ─► follower ─────────────► rack
//               speed control ─► throttle, brake (or torque at the wheels) ─┐
//               shifting ─► gear, clutch, and the throttle's share ◄────────┘
//               ending ─► whether the run is over
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

// All that a driver's later decisions depend on, besides where the controls are: with the schedule's own memory a run goes on
// with the same bits.
struct DriverMemory {
    bool begun = false;
    double first_time = 0;  // of the first decision [s]
    PathMemory path;
    SpeedMemory speed;
    ShiftMemory shifting;
    EndingMemory ending;
};
static_assert(std::is_trivially_copyable_v<DriverMemory>);

class Driver {
public:
    Driver() = default;  // does nothing
    // The description's interval must be the one at which he is asked: he leads his controls from one decision to the next.
    // Throws std::invalid_argument for what cannot be driven: a path through one point, a gear that does not exist.
    Driver(const DriverDescription& description, const DrivenCar& car, const Column& column);

    bool acts() const { return follower_ || speed_ || shifting_ || ending_; }
    double interval() const { return interval_; }  // [s]
    // Keeps what the scenario does with the throttle, for a driver who only shifts. Once, before the first decision.
    void begin(const Schedule& schedule);
    // Decides for the coming interval; without allocation. Again at the first instant: decides anew, so that gears can be
    // chosen once a gear is in and the shafts' speeds are known.
    void act(const Senses& senses, Schedule& schedule);

    // Why the run is over, with what was reached.
    std::optional<std::string> ended() const;
    // What could not be done, with what was reached.
    std::vector<std::string> complaints() const;
    // Of the center of mass beside the path; zeros without one.
    PathPlace place() const { return {memory_.path.station, memory_.path.offset}; }

    const DriverMemory& memory() const { return memory_; }
    void restore(const DriverMemory& memory) { memory_ = memory; }

private:
    void work_pedals(const Senses& senses, Schedule& schedule, bool first);
    void work_gears(const Senses& senses, double throttle, Schedule& schedule, bool first);

    double interval_ = 0.005;
    DrivenCar car_;
    std::optional<PathFollower> follower_;
    std::optional<SpeedControl> speed_;
    std::optional<Shifting> shifting_;
    std::optional<Ending> ending_;
    bool brakes_ = false;        // the brake is the driver's
    Signal scheduled_throttle_;  // what the scenario says
    DriverMemory memory_;
};

}  // namespace hamilcar
