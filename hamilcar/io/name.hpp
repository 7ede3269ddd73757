// Names of things that come several times.
#pragma once

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

#include "hamilcar/io/table_reader.hpp"

namespace hamilcar::io {

// Checks the name of a table and adds it to those taken by `others`. Names become parts of channel and file names.
inline void check_name(const TableReader& table, std::vector<std::string>& taken, const std::string& others) {
    const std::string name = table.text("name");
    const auto allowed = [](unsigned char c) { return std::isalnum(c) || c == '_'; };
    table.expect(std::ranges::all_of(name, allowed), "name", "letters, digits and '_' only");
    table.expect(std::ranges::find(taken, name) == taken.end(), "name", "a name that no other " + others + " has");
    taken.push_back(name);
}

}  // namespace hamilcar::io
