// What a person holds: keys or axes, selector and gear. The range of each is checked where it is received.
#pragma once

namespace hamilcar::live {

enum class Device { keys, axes };

// Where the gear lever stands. A car that a mere torque drives knows reverse, and everything else as ahead.
enum class Selector { drive, neutral, reverse, manual };

struct Controls {
    Device device = Device::keys;
    double steer = 0;     // -1 full right to 1 full left
    double throttle = 0;  // 0 to 1
    double brake = 0;     // 0 to 1
    Selector selector = Selector::drive;
    int gear = 1;       // wanted where the selector is at `manual`
    double clutch = 0;  // pedal, 0 to 1 all the way down
};

}  // namespace hamilcar::live
