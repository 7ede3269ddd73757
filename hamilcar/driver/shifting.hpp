// Gears and clutch of the first power unit: a driver with a manual gearbox, or an automatic gearbox.
//
// Manual: while the gearbox input turns more slowly than the engine's idle speed, the clutch slips and closes with rising rotor
// speed; thus the engine neither stalls nor overspeeds, whatever the clutch's capacity. A gear change closes the throttle, opens
// the clutch, changes the gear, matches the rotor's speed and closes the clutch, all within the gearbox's shift time.
// Automatic: the gear number changes at a constant rate from old to new, and the ratio is interpolated.
//
// Shift speeds lie between those for the closed and for the open throttle. No gear is chosen that would be left again at once:
// the downshift speed of a gear is below the speed at which the upshift into it ends.
#pragma once

#include "hamilcar/description/driver.hpp"
#include "hamilcar/driver/observation.hpp"

namespace hamilcar {

// Everything that later decisions depend on.
struct ShiftMemory {
    enum class Phase { unbegun, driving, launching, changing };
    Phase phase = Phase::unbegun;
    int gear = 0, next = 0;  // engaged, and next during a change
    double clock = 0;        // since the change began, or since it ended [s]
    double throttle = 0;     // smoothed, for the shift points [1]
};

class Shifting {
public:
    // Throws std::invalid_argument for a gear that does not exist.
    Shifting(const ShiftingDescription& description, const DrivenCar& car);

    bool is_active() const { return car_.gears > 0; }
    bool operates_clutch() const { return is_active() && car_.has_clutch; }
    // Whether it closes the throttle during changes.
    bool cuts_throttle() const { return is_active() && !fixed_ && !ramps_; }

    // Whether the driveline is open or slips, so that no drive force is available.
    bool interrupts(const ShiftMemory& memory) const {
        const bool lever = memory.phase == ShiftMemory::Phase::changing && !ramps_;
        return operates_clutch() && (lever || memory.phase == ShiftMemory::Phase::launching);
    }

    // Targets for the end of the next interval.
    struct Decision {
        double gear = 0;  // set at once, unless `evenly`
        bool evenly = false;
        double clutch = 0;          // pedal [1]
        double throttle_share = 1;  // of the demanded throttle [1]
        double min_throttle = 0;    // to match the rotor's speed [1]
    };
    // `throttle`: the demand. The first decision selects the suitable gear at once, or the first gear if none is engaged.
    Decision decide(const Observation& observation, double throttle, double interval, ShiftMemory& memory) const;

private:
    double ratio(int gear) const;
    double upshift_speed(double throttle) const;
    double downshift_speed(int gear, double throttle) const;
    double launch_clutch(double rotor, double throttle) const;
    int suitable_gear(const PowerUnitObservation& unit, double ground, const ShiftMemory& memory) const;
    int lower_gear(double shaft, double throttle, int from, int gear) const;
    void begin(const Observation& observation, double throttle, ShiftMemory& memory) const;
    void settle(const PowerUnitObservation& unit, ShiftMemory& memory) const;
    Decision change(const PowerUnitObservation& unit, double interval, ShiftMemory& memory) const;
    Decision hold(const PowerUnitObservation& unit, ShiftMemory& memory) const;

    DrivenCar car_;
    bool fixed_ = false, ramps_ = false;
    int first_ = 1;  // lowest gear that is chosen, or the fixed one
};

}  // namespace hamilcar
