// A new vehicle as a commented file that runs: hardpoints as they usually are, scaled to track and wheel, on the masses of a
// class; springs, dampers, anti-roll bars and steering sized by the kinematics of these very linkages. Every number of it is
// an estimate, graded [E], to be replaced by what is known.
#pragma once

#include <string>

#include "hamilcar/suspension/recipe.hpp"
#include "hamilcar/template/vehicle_class.hpp"

namespace hamilcar {

struct TemplateRequest {
    std::string name;
    const Recipe *front = nullptr, *rear = nullptr;  // the front one can be steered
    const VehicleClass* like = nullptr;
    DrivenWheels drive = DrivenWheels::rear;
    ClassValues values{};
};

// Whether it can be in front: the rack moves its wheels.
bool can_be_steered(const Recipe& recipe);

// The file's text. Throws NoSolution where such a vehicle does not assemble.
std::string vehicle_template(const TemplateRequest& request);

}  // namespace hamilcar
