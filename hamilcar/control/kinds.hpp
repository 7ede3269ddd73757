// The list of kinds of controllers: those that come with Hamilcar, and those that a program adds.
#pragma once

#include "hamilcar/control/controller.hpp"

namespace hamilcar {

ControllerKind external_control();   // external.cpp
ControllerKind anti_lock();          // anti_lock.cpp
ControllerKind traction_control();   // traction_control.cpp
ControllerKind stability_control();  // stability_control.cpp
ControllerKind active_anti_roll();   // active_anti_roll.cpp
ControllerKind skyhook();            // skyhook.cpp
ControllerKind torque_vectoring();   // torque_vectoring.cpp
ControllerKind rear_steer();         // rear_steer.cpp

// All kinds, in the order of the list above, then those that were added.
std::vector<const ControllerKind*> controller_kinds();
const ControllerKind* find_controller_kind(std::string_view keyword);
// Adds one for the rest of the program, before any file that names it is read. Throws std::invalid_argument where the keyword is taken.
void add_controller_kind(ControllerKind kind);

}  // namespace hamilcar
