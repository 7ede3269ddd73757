// JSON Schemas of files, for editors and linters, made of what the readers ask for: no table of
// keys exists beside the readers that could disagree with them.
//
// A schema knows every key, its unit and range, the words it may be, and which keys belong to which word. It does not
// know what several values mean together (inertias, linkages that move): that is for `hamilcar check`.
#pragma once

#include <functional>
#include <string>

#include "hamilcar/io/table_reader.hpp"

namespace hamilcar::io {

// The text of a schema, JSON Schema draft 7, of the files that `read` reads.
std::string schema_of(const std::string& title, const std::function<void(const TableReader&)>& read);
std::string vehicle_schema();
std::string scenario_schema();

}  // namespace hamilcar::io
