// JSON Schemas of vehicle and scenario files, for editors and linters, made of what the readers ask for: no table of
// keys exists beside the readers that could disagree with them.
//
// A schema knows every key, its unit and range, the words it may be, and which keys belong to which word. It does not
// know what several values mean together (inertias, linkages that move): that is for `hamilcar check`.
#pragma once

#include <string>

namespace hamilcar::io {

// The text of a schema, JSON Schema draft 7.
std::string vehicle_schema();
std::string scenario_schema();

}  // namespace hamilcar::io
