// Files that come with hamilcar: vehicles, scenarios, tires.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace hamilcar::io {

// "vehicles/bmw_323i.toml": where it is, below this folder, beside the program ("../share/hamilcar"), in the source or where
// hamilcar is installed.
std::optional<std::string> find_shipped(const std::string& name);
// For who is no program of its own: takes the place of the folder beside the program. Once, before anything is looked for.
void set_shipped_folder(const std::string& folder);

// Tire property files are known by their names alone, "pacejka_205_60_r15", with the ending or without.
std::vector<std::string> shipped_tires();
// `path` if there is a file, else that of the shipped tire of that name.
std::optional<std::string> find_tire(const std::string& path, const std::string& name);

}  // namespace hamilcar::io
