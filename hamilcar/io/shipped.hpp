// Files that come with hamilcar: vehicles, scenarios, tires.
#pragma once

#include <optional>
#include <string>

namespace hamilcar::io {

// "vehicles/bmw_323i.toml": where it is, below this folder, in the source or where hamilcar is installed.
std::optional<std::string> find_shipped(const std::string& name);

}  // namespace hamilcar::io
