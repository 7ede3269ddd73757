// What parts of the driveline are told by controllers, by their places behind the first command of each (vehicle/command_layout.hpp).
#pragma once

namespace hamilcar {

// Of a wheel's brake: openings of its valves from the pedal and to the outside, share of the pump's flow.
struct BrakeCommand {
    enum : int { inlet, outlet, pump, size };
};
// Of a power unit: limits of its throttle. Of a motor besides: a torque that is added, as a share of the largest, and how much of what
// the brake pedal may ask of it is let.
struct UnitCommand {
    enum : int { max_throttle, min_throttle, size, added_torque = size, max_regeneration, motor_size };
};

}  // namespace hamilcar
