// What a driver perceives, read off a state.
#pragma once

#include "hamilcar/block/momenta.hpp"
#include "hamilcar/driver/senses.hpp"

namespace hamilcar {

// Without allocation; costs a Velocity block.
Senses sense(const Model<double>& model, const State<double>& state, const Input<double>& input);

// Of a rotor [rad/s]: with the shaft that it is coupled to, but an engine at least at its idle speed.
double starting_speed(const PowerUnit<double>& unit, double gear, double clutch, double shaft);

// Sets the rotors turning as they would at this instant's speed, gear and clutch: a start, or a first decision of a driver.
void set_rotors(const Model<double>& model, const Input<double>& input, State<double>& state);

}  // namespace hamilcar
