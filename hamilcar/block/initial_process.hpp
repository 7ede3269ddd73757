// Initial Process block (paper, section 6.1 (1)): from the given initial conditions to a complete state.
//
// Newton-Raphson closes the loops, the car settles on the road (equilibrium.hpp), and the momenta P_a(0) follow from the
// initial velocities. Runs once, before the first step, in plain doubles.
#pragma once

#include "hamilcar/block/momenta.hpp"

namespace hamilcar {

// How well one suspension's loops close at the state's coordinates.
struct LoopReport {
    int suspension = 0;
    int cut = -1;               // the equation with the largest violation; -1 without loops
    double violation = 0;       // of that equation [m]
    int nearly_redundant = -1;  // the equation closest to a combination of the others
    double mobility = 1;        // |det Phi_w| over the product of its row norms: 0 where the linkage locks
};
LoopReport inspect_loops(const Model<double>& model, const RackMotion<double>& rack, const State<double>& state,
                         int number);

struct AssemblyResult {
    bool assembled = true;
    LoopReport worst;  // of the suspension that failed, else of the one with the largest violation
};

inline constexpr double assembly_tolerance = 1e-9;  // violation of a joint [m]
inline constexpr double locked_mobility = 1e-4;     // below it Phi_w counts as singular

// Finds W by Newton-Raphson from its present values, for the V of the state.
AssemblyResult assemble(const Model<double>& model, const RackMotion<double>& rack, State<double>& state);

// Sets position and orientation of the chassis; nothing else in the state changes.
void place_chassis(const Model<double>& model, const Vec3<double>& position, const Mat3<double>& R_GC,
                   State<double>& state);

// What inputs held for long make of a state: pressures of the brakes, their valves at rest and their temperatures at a start; a rack that
// moves on its own where it is asked for, with the steering wheel, at rest.
void hold_inputs(const Model<double>& model, const Input<double>& input, State<double>& state);
// The pressures alone.
void hold_pedal(const Model<double>& model, double command, State<double>& state);

// The state at design: chassis at `position` with `R_GC`, V at design, everything at rest, loops not yet closed.
State<double> design_state(const Model<double>& model, const Vec3<double>& position, const Mat3<double>& R_GC);

// P_a(0) for the chassis moving with v_1 (velocity of its origin ; angular velocity, chassis axes) and V' = 0. Wheels
// roll without longitudinal slip.  // (57)
void set_velocities(const Model<double>& model, const Input<double>& input, const Spatial<double>& v_1,
                    State<double>& state);

}  // namespace hamilcar
