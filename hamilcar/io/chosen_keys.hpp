// Which of all keys that a table may hold a file's own choices ask for: the word that stands there, the group of keys that it uses.
#pragma once

#include <utility>
#include <vector>

#include "hamilcar/io/key_record.hpp"

namespace hamilcar::io {

struct ChosenKeys {
    TableRecord table;                // without choices
    std::vector<const Node*> unread;  // of groups of keys: they may be of one that another one overrides
    std::vector<std::pair<const Node*, const Node*>>
        contradictions;  // a key, and one of another group in the same file
};
ChosenKeys chosen_keys(const Node& table, const TableRecord& format);

// What the files hold that `describe` reads; found once, and kept: who tries many files does not wait for it each time.
using DescribeFormat = void (*)(const TableReader&);
const TableRecord& format_of(DescribeFormat describe);

}  // namespace hamilcar::io
