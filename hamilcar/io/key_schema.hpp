// Records of keys as pieces of a JSON Schema (draft 7).
//
// A table has two schemas. One lists all keys that may ever stand in it and what their values may be: editors complete
// and explain from it. The other says what is required, and which of the keys belong together: an editor needs no more
// of it than its verdict. It uses if and then, not oneOf, because "'ball_joint_m' is a required property" helps and
// "matches none of 13 schemas" does not.
#pragma once

#include <nlohmann/json.hpp>

#include "hamilcar/io/key_record.hpp"

namespace hamilcar::io {

using Json = nlohmann::ordered_json;  // keys in the order in which they are read

// Everything that may stand in a table; nothing is required.
Json table_schema(const TableRecord& table);

// What a table wants beyond table_schema.
Json requirements(const TableRecord& table);

}  // namespace hamilcar::io
