// All that a reader may ask for, over all files there could be. The reader is run against a KeyRecorder again and
// again, with one decision turned at a time. Each option of a decision is explored in full within the tables that it
// changes, so a choice inside of another is found (which keys does a steered axle want, if it is a solid one?), but
// choices that have nothing to do with each other are not multiplied. Whether a key is there, or is a list, is taken
// for a choice only if that alone changes other keys.
#pragma once

#include <functional>

#include "hamilcar/io/key_table.hpp"
#include "hamilcar/io/table_reader.hpp"

namespace hamilcar::io {

// Every key at its place; `choices` of a table hold what depends on words and keys in the file, as JSON Schemas.
TableRecord survey_keys(const std::function<void(const TableReader&)>& read);

}  // namespace hamilcar::io
