// Vehicles and scenarios as Python holds them: the tables that a person wrote, and what was read from them.
#pragma once

#include "hamilcar/description/scenario.hpp"
#include "hamilcar/description/vehicle.hpp"
#include "hamilcar/io/toml_document.hpp"
#include "python.hpp"

namespace hamilcar::python {

// A change is made in a copy and read: what is invalid leaves the document as it was.
template <class Description>
struct Document {
    io::Node tables;
    Description description;
    std::string source;  // the file, or "" where there is none
    int generation = 0;  // of the latest change: it overrides what was said before in another way
};
using VehicleDocument = Document<VehicleDescription>;
using ScenarioDocument = Document<ScenarioDescription>;

}  // namespace hamilcar::python
