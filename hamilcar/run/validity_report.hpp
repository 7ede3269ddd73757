// The list of what limits a run's validity, for programs and for a page.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "hamilcar/io/page.hpp"
#include "hamilcar/run/validity_warning.hpp"

namespace hamilcar {

nlohmann::ordered_json validity_json(const std::vector<ValidityWarning>& list);
// Throws nlohmann::json::exception for what is no such list.
std::vector<ValidityWarning> validity_of(const nlohmann::ordered_json& json);

// A heading with a table, or one sentence that there is nothing to tell.
void add_validity(const std::vector<ValidityWarning>& list, io::Page& page);

}  // namespace hamilcar
