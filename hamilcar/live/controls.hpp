// The user's inputs: keys or axes, selector and gear. Ranges are checked on receipt.
#pragma once

namespace hamilcar::live {

enum class Device { keys, axes };

// Position of the gear lever. A car without power units, driven by a torque, has reverse; any other position is forward.
enum class Selector { drive, neutral, reverse, manual };

struct Controls {
    Device device = Device::keys;
    double steer = 0;     // -1 full right to 1 full left
    double throttle = 0;  // 0 to 1
    double brake = 0;     // 0 to 1
    Selector selector = Selector::drive;
    int gear = 1;       // requested gear if the selector is at `manual`
    double clutch = 0;  // pedal, 0 released to 1 fully pressed
};

}  // namespace hamilcar::live
