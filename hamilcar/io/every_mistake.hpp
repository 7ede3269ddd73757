// All mistakes of a file at once. A reader ends with the first; what the file may hold is known from what the reader asks for
// without one (key_record.hpp), and so every key can be compared with it: is it known, is it there, is its value of that kind
// and in that range? What several values mean together only the reader knows, once each is right by itself.
#pragma once

#include <functional>

#include "hamilcar/io/chosen_keys.hpp"
#include "hamilcar/io/error.hpp"
#include "hamilcar/io/table_reader.hpp"

namespace hamilcar::io {

// Throws what `read` throws; where that is about what stands in the file, with all mistakes of the file: unknown keys first, then
// by their places. `describe` reads the same without a file; what it says is kept for the next mistake of such a file.
void with_every_mistake(const Node& document, DescribeFormat describe, const std::function<void()>& read);

// One message for each.
std::vector<std::string> mistakes_of(const Node& document, const TableRecord& format);

}  // namespace hamilcar::io
